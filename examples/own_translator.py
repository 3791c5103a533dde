"""Bring your own translator: anything with a name and a method translate(request, scene).

Run in the root of the repository: python examples/own_translator.py
"""

import re

from iconjax import edit
from iconjax.errors import TranslationError
from iconjax.language.base import Translation
from iconjax.scene.types import Scene


class TurnOnly:
    """Reads "turn NAME by N" and nothing else."""

    name = "turn-only"

    def translate(self, request: str, scene: Scene) -> Translation:
        found = re.fullmatch(r"turn (.+) by (-?\d+)", request)
        if not found or found[1] not in (*scene.names, *scene.objects):
            raise TranslationError(f"say 'turn NAME by N', where NAME is one of {', '.join(scene.objects)}")
        name, degrees = found.groups()
        program = (f'rotate("{name}")', f'equal(rotation("{name}"), {degrees})')
        return Translation(program, self.name, (f"turn {name} by {degrees} degrees",))


result = edit("eval/benchmark/umbrella-45", request="turn Umbrella by 30", translator=TurnOnly())
print(result.explain())
result.save("edited.png")
