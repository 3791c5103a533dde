"""Wholes without a name of their own: "the whole joystick" of a base and a stick, and what a pot holds."""

from __future__ import annotations

from iconjax.language.lexicon import Lexicon
from iconjax.language.names import Names
from iconjax.language.things import Phrase

GENERIC = frozenset({"thing", "lot", "picture", "icon", "image", "drawing", "scene", "composition"})
"""Nouns that may mean all that the picture shows."""
WHOLES = frozenset({"whole", "entire", "complete"})


def with_wholes(words: list[str], lexicon: Lexicon, names: Names) -> list[str]:
    """The whole picture's things for "the whole X" and "everything", where no thing is called X."""
    for i, word in enumerate(words):
        after = words[i + 1] if i + 1 < len(words) else ""
        spoken_of = any(names.hear(w) is not None for w in words[:i])
        generic = after in GENERIC and names.hear(after) is None and not spoken_of
        whole = word in WHOLES and after.isalpha() and (generic or _unnamed(after, lexicon, names))
        every = word == "everything" and after not in ("else", "that", "in", "on") and not spoken_of
        every = every or (words[i : i + 3] == ["all", "of", "it"] and not spoken_of)
        if not whole and not every:
            continue
        every_name = spelt(names)
        if every_name is None:
            return words
        start = i - 1 if i > 0 and words[i - 1] == "the" else i
        end = i + 2 if whole else i + 1 if word == "everything" else i + 3
        names.notes.append(f'"{" ".join(words[start:end])}" taken for {" and ".join(names.scene.objects)}')
        return [*words[:start], *every_name, *words[end:]]
    return words


def _unnamed(word: str, lexicon: Lexicon, names: Names) -> bool:
    """Whether a noun names no object of the picture as it stands, and is no word of the grammar."""
    if lexicon.singular(word) in names.vocabulary or (
        word in lexicon.words and word not in ("thing", "picture", "icon")
    ):
        return False
    nouns = names.hear(word) or ()
    akin = any(len(v) > 3 and word != v and word.endswith(v) for v in names.vocabulary)
    if not nouns and not akin and len(names.scene.objects) > 1:
        return False  # it may be any one of them
    tails = any(word != t and word.endswith(t) for n in nouns for sense in names.hearing.senses(n) for t in sense)
    return tails or not nouns or not names.like(Phrase(word, nouns=nouns))


def spelt(names: Names) -> list[str] | None:
    """All objects by name, where they hang together; None where some stand apart."""
    objects, shapes = list(names.scene.objects), names.shapes
    reached, todo = {objects[0]}, [objects[0]]
    while todo:
        here = todo.pop()
        near = [o for o in objects if o not in reached and shapes.lies(here, "touch", o)]
        reached.update(near)
        todo.extend(near)
    plain = all(o.replace(" ", "").isalpha() for o in objects)
    if len(reached) < len(objects) or not plain:
        return None
    out: list[str] = []
    for name in objects:
        out.extend([*(["and"] if out else []), "the", *name.lower().split()])
    return out + (["together"] if len(objects) > 1 else [])


def held_by(name: str, names: Names) -> list[str]:
    """Objects that lie in or on a thing, or in or on what it holds."""
    own = names.scene.segments[names.scene.members(name)[0]].object
    held, todo = list[str](), [name]
    while todo:
        here = todo.pop()
        for other in names.scene.objects:
            lies = any(names.shapes.lies(other, kind, here) for kind in ("inside", "on"))
            if lies and other not in (own, *held):
                held.append(other)
                todo.append(other)
    return [o for o in names.scene.objects if o in held]
