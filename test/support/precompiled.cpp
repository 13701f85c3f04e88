// A target needs a source: this one includes the headers that all tests share.
