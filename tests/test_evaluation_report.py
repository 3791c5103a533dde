"""What a run tells: intervals, tables, and the page that shows every case."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from evaluation_support import BENCHMARK, shift, write_case

from iconjax.errors import InputError
from iconjax.evaluation.bootstrap import mean_over_cases, ratio_of_means
from iconjax.evaluation.cases import EvalCase
from iconjax.evaluation.editors import Edited
from iconjax.evaluation.page import badness
from iconjax.evaluation.paper import published
from iconjax.evaluation.progress import Bar, Step
from iconjax.evaluation.report import Report
from iconjax.evaluation.run import run_benchmark
from iconjax.search.types import ConstraintReport

HOSTILE = "</script><script>alert(1)</script><b>&amp;"


def test_an_interval_covers_the_true_mean_about_as_often_as_it_says() -> None:
    draw = np.random.default_rng(5)
    samples = [draw.exponential(1.0, 60) for _ in range(200)]
    found = [mean_over_cases(list(sample)) for sample in samples]
    covered = np.mean([f.low <= 1.0 <= f.high for f in found if f is not None])
    assert 0.85 < covered < 0.99


def test_intervals_are_the_same_every_time_and_narrow_with_more_cases() -> None:
    few, many = [0.0, 1.0] * 10, [0.0, 1.0] * 100
    assert mean_over_cases(few) == mean_over_cases(few)
    a, b = mean_over_cases(few), mean_over_cases(many)
    assert a is not None and b is not None and a.mean == b.mean == 0.5
    assert a.high - a.low > 2 * (b.high - b.low) > 0
    assert mean_over_cases([]) is None


def test_a_ratio_is_taken_case_by_case() -> None:
    """What is always twice as large is twice as large for certain, however much the cases differ."""
    values = [0.1, 3.0, 0.7, 12.0]
    ratio = ratio_of_means([2 * v for v in values], values)
    assert ratio is not None and (ratio.low, ratio.mean, ratio.high) == pytest.approx((2, 2, 2))
    assert ratio_of_means(values, [0.0] * 4) is None
    assert ratio_of_means(values, values[:2]) is None


def test_the_paper_s_figures_stand_beside_the_method_they_are_for() -> None:
    found = {name: published(name) for name in ("ours +program", "paper -RS +llm-replay", "dc +image", "unedited")}
    assert [f and f.cd for f in found.values()] == ["0.41; 0.475", "0.997", "1.40", None]


def good(case: EvalCase) -> Edited:
    held = (ConstraintReport('translate("Red")', "primary", 0.0, "px", True),)
    details = {"timings": {"compile": 2.0, "search": 1.0}, "usage": {"calls": 1, "input_tokens": 100}}
    return Edited({1: shift(20, 0)}, case.truth_image, held, details, seconds=4.0)


def poor(case: EvalCase) -> Edited:
    if case.id.startswith("c"):
        raise ValueError(HOSTILE)
    missed = (ConstraintReport('equal(min_x("Red"), 99)', "primary", 33.0, "px", False),)
    return Edited({1: shift(0, 9)}, case.image, missed, {"program": [HOSTILE]})


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Report]:
    place = tmp_path_factory.mktemp("report")
    for name in ("a", "b", "c"):
        write_case(place / "bench" / name)
    (place / "bench" / "b" / "case.json").write_text(
        (place / "bench" / "b" / "case.json").read_text().replace("Move the red", HOSTILE)
    )
    return place / "out", run_benchmark(place / "bench", place / "out", [], editors={"good": good, "poor": poor})


class Page(HTMLParser):
    """Counts tags and collects what attributes would load."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.loaded: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.loaded += [value or "" for name, value in attrs if name in ("src", "href", "srcset", "data", "action")]


def test_the_page_shows_every_case_and_loads_nothing(run: tuple[Path, Report]) -> None:
    out, _ = run
    text = (out / "report.html").read_text("utf-8")
    page = Page(text)
    assert page.tags.count("script") == 1 and "b" in page.tags
    assert page.loaded and all(link.startswith("data:image/webp;base64,") for link in page.loaded)
    assert not re.search(r"url\(|@import|https?://", text)
    assert re.findall(r'<tr id="(\w+)">', text) == ["a", "b", "c"]
    # Before, one solution and two methods for each case, but no picture of the edit that failed.
    assert page.tags.count("img") == 3 * 4 - 1
    assert len(text) < 60_000
    assert "missed by 33 px" in text and "failed" in text


def test_what_comes_from_outside_is_text_on_the_page(run: tuple[Path, Report]) -> None:
    text = (run[0] / "report.html").read_text("utf-8")
    assert "alert(1)" in text and "<script>alert" not in text


def test_worse_results_come_first(run: tuple[Path, Report]) -> None:
    _, report = run
    (fine, *_), (wrong, _, failed) = report.of("good"), report.of("poor")
    assert fine.cd is not None and badness(fine) < badness(replace(fine, cd=fine.cd + 1)) < badness(wrong)
    assert badness(wrong) < badness(failed)


def test_tables_hold_times_tokens_and_a_comparison(run: tuple[Path, Report]) -> None:
    out, report = run
    table = report.markdown()
    assert table == (out / "table.md").read_text()
    assert "| good |  | 2.00 | 1.00 |  | 4.00 |" in table  # translate and render were not measured
    assert "| good | 1.00 | 100 |" in table
    again = Report(report.records, ("good", "poor", "unedited", "truth")).markdown()
    assert "| poor | 0.00 [0.00, 0.00] | 3 | 0 | 0 |" in again


def test_tables_are_put_between_the_marks_of_a_file(
    run: tuple[Path, Report], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARK.parent))
    from tables import merged, put_into

    report, lines = merged([run[0], run[0]])
    assert report.rows == Report(report.records, ("good", "poor", "unedited", "truth")).rows
    assert len(lines) == 2 and "3 cases, unedited, truth, good, poor" in lines[0]
    file = tmp_path / "page.md"
    file.write_text("a\n<!-- tables main -->\nold\n<!-- end -->\nb\n<!-- tables x -->\n<!-- end -->\n")
    put_into(file, "main", "new")
    assert file.read_text() == ("a\n<!-- tables main -->\n\nnew\n<!-- end -->\nb\n<!-- tables x -->\n<!-- end -->\n")
    with pytest.raises(InputError, match="no lines"):
        put_into(file, "other", "new")


def test_the_bar_tells_the_time_that_is_left(run: tuple[Path, Report]) -> None:
    class Terminal:
        text = ""

        def write(self, text: str) -> None:
            self.text += text

        def flush(self) -> None:
            pass

    now = iter((0.0, 100.0, 102.0, 104.0))  # the first case compiles
    terminal = Terminal()
    bar = Bar(terminal, lambda: next(now))  # type: ignore[arg-type]
    good, *_ = run[1].of("good")
    (*_, failed) = run[1].of("poor")
    bar(Step(good, 1, 10))
    assert "15:00 left" in terminal.text
    bar(Step(failed, 2, 10))
    bar(Step(good, 3, 4000))
    assert terminal.text.count("\n") == 1 and "2/10 poor: c: failed: ValueError" in terminal.text
    assert "3/4000  38:29:23 left" in terminal.text
