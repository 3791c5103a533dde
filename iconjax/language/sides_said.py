"""Ends of things, written out: "from below", "so that it ends where the board ends"."""

from __future__ import annotations

import re
from collections.abc import Sequence

from iconjax.errors import TranslationError
from iconjax.language.idioms import BREAKS
from iconjax.language.lexicon import Lexicon
from iconjax.language.names import Names, Phrase
from iconjax.language.phrases import PhraseReader
from iconjax.language.wordings import amount_end, scan

GIVING: dict[tuple[str, ...], str] = {
    ("from", "below"): "bottom",
    ("from", "underneath"): "bottom",
    ("from", "above"): "top",
    **{("from", "the", side): side for side in ("left", "right", "top", "bottom")},
}
"""What says from where a thing is made shorter or longer -> the end that gives."""
SAME = (
    r"(?:where|level with|flush with|together with|in line with|at the same (?:point|height|place|spot) (?:as|where))"
)
ENDS = r"(?:ends?|stops?|finish(?:es)?)"
MEETS = re.compile(
    rf"\b(?:it|they) {ENDS} (?:exactly |just |right |precisely )?{SAME} (.+?)(?: {ENDS}| does| do)?(?= [.;:,!?]|$)"
)
GIVEN = re.compile(r"\bat the (top|bottom|left|right)\b")
REACHES = re.compile(
    r"\b(it|they) (?:reach|reaches|extends?|spans?|stretch|stretches|goes|go|runs?) (?:exactly |just |all the way )?"
    r"from (the [^.;:,!?]+? of [^.;:,!?]+?) to (the [^.;:,!?]+? of [^.;:,!?]+?)(?= [.;:,!?]|$)"
)
OPPOSED = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}
NAMED = {"left": "left end", "right": "right end", "top": "upper end", "bottom": "lower end"}
MOVING = frozenset({"move", "shift", "slide", "push", "pull", "bring"})


def given_end(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "Shorten the post from below" shortens it at the bottom."""

    def step(i: int) -> tuple[list[str], int] | None:
        said = next((s for s in GIVING if tuple(words[i : i + len(s)]) == s), None)
        if said is None:
            return None
        end = i + len(said)
        after = words[end] if end < len(words) else "."
        if after not in (*BREAKS, "and", "by", "so", "until", "till", "to") or not _resizes(words[:i], lexicon):
            return None
        return ["at", "the", GIVING[said]], end

    return scan(words, step)


def _resizes(words: Sequence[str], lexicon: Lexicon) -> bool:
    start = max((k + 1 for k, w in enumerate(words) if w in BREAKS), default=0)
    return any(
        (e.category == "verb" and e.value == "scale")
        or (e.category == "adjective" and e.info["degree"] in ("more", "less"))
        for w in words[start:]
        for e in lexicon.phrases.get((w,), ())
    )


def same_end(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "... at the bottom so that it ends where the board ends": the bottoms meet."""
    text = " ".join(words)
    meets = MEETS.search(text)
    given = GIVEN.search(text[: meets.start()]) if meets else None
    if meets is None or given is None:
        return words
    plain = f"its {given[1]} is flush with the {given[1]} of {meets[1]}"
    return (text[: meets.start()] + plain + text[meets.end() :]).split()


def reaching(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "So that they reach from the left edge of A to the right edge of B": each end meets one of them."""
    text = " ".join(words)
    found = REACHES.search(text)
    if found is None:
        return words
    whose = "its" if found[1] == "it" else "their"
    ends = [_end_of(found[2], lexicon), _end_of(found[3], lexicon)]
    if ends[0] in OPPOSED and not ends[1]:
        ends[1] = OPPOSED[ends[0]]
    if ends == ["outer", "outer"] or ends == ["inner", "inner"]:
        reader = PhraseReader(words, lexicon, names)
        start = next(i for i in range(len(words)) if words[i : i + 2] == ["from", "the"])
        first = reader.read(start + 1)
        at = _middle(first[0], names) if first is not None else None
        ends = ["left", "right"] if at is not None and at < names.scene.width / 2 else ["right", "left"] if at else ends
    if set(ends) not in ({"left", "right"}, {"top", "bottom"}):
        return words
    plain = f"{whose} {NAMED[ends[0]]} is flush with {found[2]} and {whose} {NAMED[ends[1]]} is flush with {found[3]}"
    return (text[: found.start()] + plain + text[found.end() :]).split()


def _end_of(text: str, lexicon: Lexicon) -> str:
    words = text.split()
    got = lexicon.match(words, int(words[0] == "the"), "side")
    return got[0].value if got is not None else ""


def _middle(phrase: Phrase, names: Names) -> float | None:
    """How far right the middle of the owner of a side lies, in px; None where it is not one thing."""
    try:
        found = names.resolve(phrase.owner) if phrase.owner is not None else ()
    except TranslationError:
        return None
    return names.shapes.centre(found[0])[0] if len(found) == 1 else None


def outward(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """ "15 px further out", "move it out by 15 px" go outward."""

    def step(i: int) -> tuple[list[str], int] | None:
        at = i + (words[i] in ("further", "farther"))
        if not (words[at : at + 1] and words[at] in ("out", "in")) or i == 0:
            return None
        after = words[at + 1] if at + 1 < len(words) else "."
        measured = lexicon.knows(words[i - 1], {"unit"})
        led = after == "by" and amount_end(words, at + 2, lexicon) is not None
        led = led and any(w in MOVING for w in words[:i])
        ends = after in (*BREAKS, "each", "and", "please")
        if not (led or ((measured or at > i) and ends)):
            return None
        return ["outward" if words[at] == "out" else "inward"], at + 1

    return scan(words, step)
