"""Relations seen in the unedited picture: the candidate secondary constraints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

Kind = Literal["overlap", "inside", "contain", "near"]
Scope = Literal["inter", "intra-crucial", "intra"]


@dataclass(frozen=True)
class Contact:
    """Where two segments meet, as material points of each.

    The points of a pair face each other over the (possibly empty) gap between the two outlines.

    Attributes:
        gap: least distance between the two, px.
        length: extent of the place where they meet, px.
        share: share of the first one's outline that lies at the contact, 0..1; `share_b` likewise for the second.
        middle: (2, 2) the meeting point on the first and on the second segment, px.
        first, second: (2, 2) the same at the two ends of the contact.
        normal: (2,) unit vector across the contact, from the first to the second.
    """

    gap: float
    length: float
    share: float
    share_b: float
    middle: Float[np.ndarray, "2 2"]
    first: Float[np.ndarray, "2 2"]
    second: Float[np.ndarray, "2 2"]
    normal: Float[np.ndarray, "2"]


@dataclass(frozen=True)
class Relation:
    """A relation between segments `a` and `b` (positions in the scene).

    Attributes:
        kind: "inside" (a lies in b), "contain" (b lies in a), "overlap" (they are connected), or "near" (parts of one
            object, or a lone object and the nearest other, that only lie close to each other; beyond the paper).
        scope: paper's types: between objects, crucial or not within an object.
        contact: where they meet.
        embedded: a lies in or on b to such an extent that it is a detail of b (kind "inside" only).
    """

    a: int
    b: int
    kind: Kind
    scope: Scope
    contact: Contact
    embedded: bool = False
