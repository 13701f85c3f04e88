// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
// A target needs a source: this is the one of targets that only have precompiled headers for others.
