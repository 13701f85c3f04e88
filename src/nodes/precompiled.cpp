// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A target needs a source: this one includes the headers that all nodes share.
