"""Readings of a change of size."""

from __future__ import annotations

from collections.abc import Iterator

from iconjax.errors import TranslationError
from iconjax.language.clauses import Amount, Clause
from iconjax.language.context import Context
from iconjax.language.frames import Change, Slots
from iconjax.language.names import Reference
from iconjax.language.reading import followed, is_own, listed

BARE = 0.4
"""A share without "by" or "to" up to which it is more likely one of change ("the boot 20 %")."""
SIDES = {"left": ("right", "left"), "right": ("left", "right"), "up": ("bottom", "top"), "down": ("top", "bottom")}
"""Direction -> the sides that stay where a thing grows and where it shrinks that way."""


def scale(context: Context, slots: Slots, theme: Reference) -> Iterator[Clause]:
    verbs = [v for v in slots.verbs if v.value == "scale"]
    info = dict(verbs[0].info) if verbs else {}
    lifting = next((v.info["direction"] for v in slots.verbs if v.info.get("direction")), "")
    if slots.changes and lifting:
        info["sign"] = 1 if lifting == "up" else -1
        slots.verbs = [v for v in slots.verbs if not v.info.get("direction")]
    pinned = pin(context, slots, info)
    changes = slots.changes or [Change(default_dim(context, slots, theme, info, pinned), 0, slots.amount)]
    if slots.changes and slots.amount is not None:
        changes[0].amount = changes[0].amount or slots.amount
    slots.amount = None
    if (
        info.get("dim")
        and all(c.dim in ("size", "hori", "vert") and c.sign == 0 for c in changes) is False
        and len(changes) == 1
        and changes[0].sign
    ):
        raise TranslationError("two different changes of size in one clause")
    bring = [v for v in slots.verbs if v.value == "move" and not v.info.get("direction")]
    if bring:
        slots.verbs = [v for v in slots.verbs if v not in bring]
    for change in changes:
        yield from changed(context, change, info, theme, slots, pinned)


def pin(context: Context, slots: Slots, info: dict[str, object]) -> str:
    """A direction with a verb of size says which side gives: "stretch to the right" keeps the left side."""
    if info.get("base") in ("scale", "resize", "rescale", "size", "slim", "thin", "narrow"):
        _scaled_up_or_down(slots, info)
    side = slots.marks.get("stays", "")
    for shift in slots.shifts:
        if "move" in slots.kinds() and any(c.amount for c in slots.changes):
            break
        if shift.direction not in SIDES:
            raise TranslationError(f'which side should give is not clear: "{shift.direction}wards" of what?')
        grows = int(str(info.get("sign", 0))) >= 0
        opposite, same = SIDES[shift.direction]
        side = opposite if grows else same
        target = next((c for c in slots.changes if c.amount is None), None)
        if shift.amount is not None and target is not None:
            target.amount = shift.amount
        elif shift.amount is not None:
            slots.amount = slots.amount or shift.amount
        slots.shifts = []
    if "down to" in slots.marks and int(str(info.get("sign", 0))) < 0 and "burn" in str(info.get("forms", "")):
        base = str(info.get("base", ""))
        if base in ("burn", "burn down", "melt", "melt down", "cut", "cut down", "chop", "saw"):
            side = side or "bottom"
    elif str(info.get("base", "")).endswith(" down") and info.get("base") not in (
        "scale down",
        "size down",
        "slim down",
        "thin down",
    ):
        side = side or "bottom"
    return side


def _scaled_up_or_down(slots: Slots, info: dict[str, object]) -> None:
    """ "Scale it up by 10 %": here up and down say larger and smaller."""
    for shift in [s for s in slots.shifts if s.direction in ("up", "down")]:
        info["sign"] = 1 if shift.direction == "up" else -1
        slots.shifts = [s for s in slots.shifts if s is not shift]
        waiting = next((c for c in slots.changes if c.amount is None), None)
        if shift.amount is not None and waiting is not None:
            waiting.amount = shift.amount
        elif shift.amount is not None:
            slots.amount = slots.amount or shift.amount


def default_dim(context: Context, slots: Slots, theme: Reference, info: dict[str, object], pinned: str) -> str:
    amount = slots.amount
    if amount is not None and amount.of is not None and amount.of.dim not in ("gap",) and not info.get("dim"):
        return amount.of.dim
    if info.get("dim"):
        return str(info["dim"])
    if pinned:
        return "vert" if pinned in ("top", "bottom") else "hori"
    if "off" in slots.marks:
        return "length"
    cuts = info.get("factor") == 0.5 or info.get("cuts")
    slender = bool(slots.theme) and all(context.names.shapes.slender(n) for n in theme.names)
    if cuts and slender and (amount is None or amount.of is None):
        return "length"
    if info.get("stretch") and followed(slots):
        return "size"
    if info.get("stretch"):
        raise TranslationError("stretch or squeeze which way? say vertically, horizontally, or in height or width")
    return "size"


def changed(
    context: Context, change: Change, info: dict[str, object], theme: Reference, slots: Slots, pinned: str
) -> Iterator[Clause]:
    """One change of one extent (or of the overall size)."""
    amount, sign = change.amount, change.sign or int(str(info.get("sign", 0)))
    if not sign and amount is not None and amount.mode == "by" and slots.connector in ("and", ",", "&"):
        sign = context.sign  # "shorter by a third, and by a quarter in width"
    context.sign = sign
    dim = str(info["dim"]) if change.sign == 0 and info.get("dim") and change.dim == "size" else change.dim
    if dim in ("short", "length") and context.complained in ("vert", "hori"):
        dim = context.complained  # "it is too tall, make it shorter"
    if dim == "proportions":
        raise TranslationError("how the proportions should change is not understood: name the height or the width")
    if "factor" in info:
        if amount is not None:
            raise TranslationError(f'"{info["base"]}" says how much, and the request names another amount')
        amount = Amount(float(str(info["factor"])), "times", "to")
    if change.same and amount is None and not change.reference and len(theme.names) > 1:
        # "A and B should be equally tall"
        yield Clause("resize", theme.names[:1])
        yield Clause("scale", theme.names[1:], Amount(1.0, "factor"), dim, reference=theme.names[:1], side=dim)
        return
    reference, reference_dim = _compared(context, change, amount, theme, dim)
    if slots.complaint and amount is None and slots.follows and slots.follows != "while":
        context.complained = dim
        yield Clause("topic", theme.names)
        return
    if amount is None and not reference:
        if followed(slots) or slots.connector == "by":
            whole = dim == "size" and not pinned and not slots.changes and not info.get("stretch")
            yield Clause("resize", theme.names, manner=frozenset({"uniform"}) if whole else frozenset())
            return
        amount = vague(sign, change, theme, slots)
    manner = {f"pin {pinned}"} if pinned else set()
    manner |= {"without motion"} if slots.follows == "by" else set()
    manner |= {"as one"} if len(theme.names) > 1 and "together" in slots.marks else set()
    size = factor(amount, sign, change, bool(reference))
    yield Clause("scale", theme.names, size, dim, reference=reference, manner=frozenset(manner), side=reference_dim)


def _compared(
    context: Context, change: Change, amount: Amount | None, theme: Reference, dim: str
) -> tuple[tuple[str, ...], str]:
    """What the new size is compared with, and which of its extents; nothing for the old size."""
    if change.reference:
        return context.reference(change.reference, theme.names).names, dim
    if amount is not None and amount.of is not None and amount.of.owners and not is_own(amount.of):
        names = context.reference(amount.of.owners, theme.names).names
        if set(names) != set(theme.names):
            return names, amount.of.dim
    return (), dim


def vague(sign: int, change: Change, theme: Reference, slots: Slots) -> Amount:
    """The amount of "make it taller"."""
    if not sign or change.same or (change.sign == 0 and not slots.changes):
        raise TranslationError(
            f'how much {listed(theme.names)} should change is not said: add e.g. "by 20 %" or "to half"'
        )
    return Amount(0.3, "ratio", "unsaid", vague=True)


def factor(amount: Amount | None, sign: int, change: Change, compared: bool) -> Amount:
    """The amount as a factor of the old (or the other's) extent, or as a length to add or to reach."""
    if amount is None:
        more = not change.same and change.sign
        return Amount(1.0, ("more" if sign > 0 else "less") if more else "factor")
    if amount.unit == "deg":
        raise TranslationError("a size cannot change by degrees")
    if amount.vague and not sign:
        raise TranslationError("larger or smaller? the request does not say")
    if amount.unit == "px":
        return _length(amount, sign, change)
    value = _times(amount, sign, change) if amount.unit in ("times", "none") else None
    if value is None:
        value = _share(amount, sign, change, compared)
    if not compared and not change.same and sign * (value - 1) < 0 and not (amount.of is not None and amount.of.owners):
        raise TranslationError("it says larger and smaller at once")
    if value <= 0.01:
        raise TranslationError(f"a change by {100 * amount.value:g} % would leave nothing")
    return Amount(round(value, 4), "factor", amount.mode, vague=amount.vague)


def _length(amount: Amount, sign: int, change: Change) -> Amount:
    if (amount.mode == "to" and change.sign == 0) or change.same:
        return Amount(amount.value, "length")
    if not sign:
        raise TranslationError("larger or smaller? the request does not say")
    return Amount(sign * amount.value, "added")


def _times(amount: Amount, sign: int, change: Change) -> float | None:
    """A factor; None for a bare number that is a share ("shrink by 0.3")."""
    value = amount.value
    if amount.unit == "none":
        if value >= 10 or amount.mode == "to":
            raise TranslationError(f"{value:g} what? say %, px or times")
        if value < 1 and amount.mode == "by" and sign:
            return None
    shrinks = sign < 0 and value >= 1 and not (change.same or amount.mode == "to" or amount.of)
    return 1 / value if shrinks else value


def _share(amount: Amount, sign: int, change: Change, compared: bool) -> float:
    """A share: of the whole ("to 60 %", "half as wide"), or of change ("by 40 %", "a third wider")."""
    value = amount.value
    if amount.mode == "by" and not sign and not change.same:
        raise TranslationError("larger or smaller? the request does not say")
    bare = not sign and not amount.mode and amount.of is None and not compared and not change.same
    if bare and value <= BARE:
        raise TranslationError(f"by {100 * value:g} %, or to {100 * value:g} %? the request does not say")
    of_something = amount.of is not None and not amount.mode and (compared or not (change.sign or sign))
    if change.same or amount.mode == "to" or sign == 0 or of_something:
        return value
    return 1 + sign * value
