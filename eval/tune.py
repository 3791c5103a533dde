"""Do the weights generalise? A leave-some-out check of the default search's cost table.

Every setting scales one group of weights by a factor. All cases are edited once with each setting; then, for each of
three folds, the setting that is best on the other two thirds is applied to the fold. This tells what tuning on cases
that one has would give on cases that one has not.

    python eval/tune.py eval/benchmark --out DIR [--factors 0.5 2] [--groups moved slid ...]
"""

from __future__ import annotations

import argparse
import json
from dataclasses import fields, replace
from pathlib import Path

from iconjax.dsl.parse import parse
from iconjax.evaluation.cases import EvalCase, list_cases, load_eval_case
from iconjax.evaluation.checks import judge
from iconjax.scene.build import build_scene
from iconjax.scene.load import load_case
from iconjax.search.api import search_edit
from iconjax.search.config import SearchConfig
from iconjax.search.weights import Costs, Forces

GROUPS = {
    "moved": ("moved", "moved_area", "along"),
    "broken": ("broken",),
    "slid": ("slid", "pulled"),
    "stretched": ("stretched", "squashed"),
    "turned": ("turned", "hung"),
    "ground": ("uprooted",),
    "alignment": ("misaligned", "asymmetric"),
    "specifier": ("idle_specifier", "extra"),
    "forces": ("crucial", "intra", "inter", "inside"),
}


def scaled(table: Costs | Forces, names: tuple[str, ...], factor: float) -> Costs | Forces:
    """The table with some weights multiplied by a factor."""
    changes = {}
    for f in fields(table):
        if f.name in names:
            value = getattr(table, f.name)
            changes[f.name] = {k: v * factor for k, v in value.items()} if isinstance(value, dict) else value * factor
    return replace(table, **changes)


def settings(groups: list[str], factors: list[float]) -> dict[str, SearchConfig]:
    """All settings by name."""
    found = {"as it is": SearchConfig()}
    for group in groups:
        for factor in factors:
            found[f"{group} x {factor:g}"] = SearchConfig(
                costs=scaled(Costs(), GROUPS[group], factor), forces=scaled(Forces(), GROUPS[group], factor)
            )
    return found


def right(case: EvalCase, folder: Path, config: SearchConfig) -> bool:
    """Whether a case with its reference program comes out right."""
    loaded = load_case(folder)
    scene = build_scene(loaded.image, loaded.segmentation)
    outcome = search_edit(scene, parse(loaded.program or "", scene.names, scene.objects), config)
    matrices = {s.id: m for s, m in zip(scene.segments, outcome.matrices, strict=True)}
    return judge(case, matrices).right


def report(results: dict[str, dict[str, bool]]) -> str:
    """Share right by setting, and of the setting chosen on two thirds on the third left out."""
    cases = sorted(results["as it is"])
    lines = ["| setting | right |", "| --- | ---: |"]
    lines += [f"| {name} | {sum(r.values())}/{len(cases)} |" for name, r in results.items()]
    kept = 0
    for fold in range(3):
        out = cases[fold::3]
        best = max(results, key=lambda name: (sum(results[name][c] for c in cases if c not in out), name == "as it is"))
        score = sum(results[best][c] for c in out)
        kept += score
        lines.append(
            f"\nFold {fold + 1}: chosen on the other two thirds: *{best}*; right on the fold: {score}/{len(out)}"
        )
    lines.append(f"\nLeft-out thirds together: {kept}/{len(cases)}")
    return "\n".join(lines)


def main() -> None:
    """Run all settings, resuming what is there."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--factors", type=float, nargs="+", default=[0.5, 2.0])
    parser.add_argument("--groups", nargs="+", default=list(GROUPS), choices=list(GROUPS))
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    cases = {folder.name: (folder, load_eval_case(folder)) for folder in list_cases(args.folder)}
    results: dict[str, dict[str, bool]] = {}
    for name, config in settings(args.groups, args.factors).items():
        path = args.out / f"{name.replace(' ', '_')}.json"
        if not path.exists():
            found = {key: right(case, folder, config) for key, (folder, case) in cases.items()}
            path.write_text(json.dumps(found, indent=1), encoding="utf-8")
        results[name] = json.loads(path.read_text(encoding="utf-8"))
        print(f"{name}: {sum(results[name].values())}/{len(cases)}", flush=True)
    text = report(results)
    (args.out / "tune.md").write_text(text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
