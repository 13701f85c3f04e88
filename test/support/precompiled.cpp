// A target has a source: this one has the headers that all tests share.
