"""A request as a list of plain lower-case words, with typing errors in known words mended."""

from __future__ import annotations

import re
from collections.abc import Iterable

FRACTIONS = {"\u00bd": "1/2", "\u00bc": "1/4", "\u00be": "3/4", "\u2153": "1/3", "\u2154": "2/3"}


def tokenise(request: str) -> list[str]:
    """Split a request into words, numbers, units and punctuation; quotes and brackets vanish."""
    text = request.lower().replace("\u2019", "'").replace("\u2018", "'").replace("\u2212", "-")
    text = re.sub(r"[-=]+>|\u2192|\u21d2", " : ", text)
    text = re.sub(r"\bi\.e\.?,?", " that is ", text)
    text = re.sub(r":=", " = ", text)
    for mark, fraction in FRACTIONS.items():
        text = text.replace(mark, f" {fraction} ")
    text = re.sub(r"\.{2,}|\u2026", " ; ", text)
    text = re.sub(r"\s*[(\[]\s*", " , ", text)
    text = re.sub(r"\s*[)\]]\s*(?=[.;:,!?]|$)", " ", text)
    text = re.sub(r"\s*[)\]]\s*", " , ", text)
    text = re.sub(r"\b(its) own\b", r"\1", text)
    text = re.sub(r"\bit's\b", "its" if not re.match(r"\s*it's\b", text) else "it is", text)
    text = re.sub(r"\b(that|there|he|she|who|what)'s\b", r"\1 is", text)
    text = re.sub(r"\bthey're\b", "they are", text)
    text = re.sub(r"\b(i)'(?:d|ll|m)\b", r"\1", text)
    text = re.sub(r"n't\b", " not", text.replace("can't", "cannot").replace("won't", "not"))
    text = re.sub(r"(?<=[a-z])s'(?=\s)", "s 's", text)
    text = re.sub(r"\b(\d+) *(?:x|×) *(?=bigger|larger|as|the|wider|taller|longer|smaller)", r"\1 times ", text)
    text = re.sub(r"(?<![\w.])-(?=\d)", " minus", text)  # kept as a word of its own
    text = re.sub(r"(?<=\d)-(?=[a-z])", " ", text)
    text = re.sub(r"(?<=[a-z.,%]) +[-\u2013] +(?=[a-z\d])| *\u2014 *", " ; ", text)  # a dash between clauses
    text = re.sub(r"(?<=[a-z]) *# *(?=\d)", " ", text)  # "piece #2"
    words: list[str] = []
    for match in re.finditer(
        r"\d+(?:st|nd|rd|th)\b|\d+(?:\.\d+)?|minus(?=\d)|[a-zà-öø-ÿ]+(?:-[a-zà-öø-ÿ]+)*|'s\b|[%°º×;:,.!?&#/=+-]",
        text,
    ):
        words.append(match.group())
    return words


def split_hyphens(words: Iterable[str], known: Iterable[str]) -> list[str]:
    """Undo hyphens in words that are not known with them."""
    keep = set(known)
    out: list[str] = []
    for word in words:
        out.extend([word] if word in keep or "-" not in word or word == "-" else word.split("-"))
    return out


def mend(word: str, known: Iterable[str]) -> str | None:
    """The one known word that `word` is a slip of the keyboard away from; None if not exactly one.

    A slip is a letter left out, put in or swapped with its neighbour; a wrong letter counts in longer words
    only, because short words that differ by a letter are more often different words.
    """
    if len(word) < 4:
        return None
    hits = {k for k in known if abs(len(k) - len(word)) <= 1 and len(k) >= 4 and _one_slip(word, k)}
    return next(iter(hits)) if len(hits) == 1 else None


def _one_slip(a: str, b: str) -> bool:
    if len(a) == len(b):
        different = [i for i, (x, y) in enumerate(zip(a, b, strict=True)) if x != y]
        if len(different) == 1:
            # another ending is another form or another word ("roller", "rolled")
            return len(a) >= 6 and 0 < different[0] < len(a) - 2
        swapped = len(different) == 2 and different[1] == different[0] + 1
        return swapped and a[different[0]] == b[different[1]] and a[different[1]] == b[different[0]]
    long, short = (a, b) if len(a) > len(b) else (b, a)
    # a plural is no slip, and a lost or added first letter makes another word more often than not
    return any(long[:i] + long[i + 1 :] == short for i in range(1, len(long) - (long[-1] == "s")))
