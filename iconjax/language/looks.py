"""Clauses that only say how things look or are: "the tyres look flat", "so many windows!"."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from iconjax.language.lexicon import Lexicon
from iconjax.language.likening import says_nothing
from iconjax.language.names import Names

LINKING = "make"
"""Kind of verbs that say nothing by themselves ("is", "has")."""
MOST_SAID = 3
PLAIN = frozenset({"descriptor", "adjective", "orient", "stop", "vague"})
AMOUNTS = frozenset({"number", "fraction", "multiple", "unit"})


def only_looks(part: Sequence[str], lexicon: Lexicon, names: Names) -> bool:
    """Whether a clause says how a thing looks, and neither that it looks too much so nor by how much."""
    at = next((i for i, w in enumerate(part) if lexicon.knows(w, {"appear"})), len(part))
    said = part[at + 1 :]
    told = all((lexicon.knows(w, PLAIN) and w != "too") or says_nothing(w, True) for w in said)
    told = told and all(names.hear(w) is None for w in said)
    more = any(e.info["degree"] != "plain" for w in said for e in lexicon.entries(w, "adjective"))
    measured = any(w.isdigit() or (w not in ("a", "an", "one") and lexicon.knows(w, AMOUNTS)) for w in part)
    return 0 < len(said) <= MOST_SAID and told and not more and at > 0 and not measured


def exclaims(part: Sequence[str], lexicon: Lexicon, names: Names) -> bool:
    """Whether a clause without any verb tells how things are."""
    entries = [e for w in part for e in lexicon.phrases.get((w,), ()) if names.hear(w) is None]
    entries = [e for e in entries if not (e.category == "verb" and e.value == LINKING)]
    doing = any(e.category in ("verb", "direction", "sense", "without") for e in entries)
    compared = any(e.category == "adjective" and e.info["degree"] != "plain" for e in entries)
    much = any(a in ("too", "so") and b in ("much", "many", "little", "few") for a, b in pairwise(part))
    return not doing and not compared and (much or bool({"such", "what"} & set(part)))
