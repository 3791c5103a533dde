"""How much an SVG may ask for: every bound in one place, far above what icons need."""

from __future__ import annotations

MAX_BYTES = 8_000_000
"""Of the file, and of what a compressed one unpacks to."""
MAX_DEPTH = 96
"""Elements inside each other, with those that `use` brings in."""
MAX_ELEMENTS = 20_000
MAX_EXPANDED = 20_000
"""Elements drawn once every reference (use, pattern, mask, marker ...) is followed."""
MAX_DRAWN = 1_200
"""Elements that are drawn one by one to find out what each shows."""
MAX_WORK = 120_000_000
"""Bytes of drawing handed to the rasteriser in all."""
MAX_SECONDS = 60.0
"""Time for drawing; looked at between elements."""
MAX_PATH = 2_000_000
"""Characters of one path."""
MAX_SPLIT = 60_000
"""Characters of the longest path that is looked into for separate outlines."""
MAX_PIECES = 64
"""A path of more separate outlines than this stays one."""
MAX_PAIRS = 300_000
"""Pairs of outlines that are compared in all; paths beyond that stay whole."""
MAX_DETAILS = 1_000
"""Where there are more segments, none is looked at as a detail of another."""
MAX_COORDINATE = 1e7
"""Largest number of a view box or a size."""
MAX_NUMBER = 1e9
"""Largest number in a shape."""
MAX_SIDE = 4096
"""Largest raster side."""
MAX_FILTERS = 200
MAX_PATTERN_SIDE = 2048
"""Largest pattern tile in pixels of the raster."""
