"""SVG icons as scenes: `open_svg` reads one, `iconjax.render.svg.write_svg` writes it back."""

from __future__ import annotations

from iconjax.scene.svg.document import Document as Document
from iconjax.scene.svg.document import SvgScene as SvgScene
from iconjax.scene.svg.document import open_svg as open_svg
from iconjax.scene.svg.items import Item as Item
