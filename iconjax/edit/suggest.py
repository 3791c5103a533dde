"""Names for segments by a vision LLM, offered to the registry of label suggesters."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np
from jaxtyping import UInt8

from iconjax.edit.choose import has_credentials, make_client
from iconjax.files import encode_image
from iconjax.language.llm.exchange import Client
from iconjax.language.llm.settings import LlmSettings
from iconjax.scene.build import build_scene
from iconjax.scene.segment.choose import register_suggester, suggester_names
from iconjax.scene.types import Segmentation


@dataclass(frozen=True)
class VisionSuggester:
    """Shows the numbered sheet to a language model.

    Attributes:
        name: "anthropic", or "llm-replay", which answers from recordings.
        client: who answers; it has to see pictures.
    """

    name: str
    client: Client

    def suggest(self, image: UInt8[np.ndarray, "H W 3"], segmentation: Segmentation) -> Mapping[int, str]:
        """See `LabelSuggester`.

        Raises:
            LlmError: no usable answer.
        """
        from iconjax.language.llm.labels import name_segments
        from iconjax.render.numbered import numbered_sheet

        ids = [int(k) for k in np.unique(segmentation.mask) if k > 0]
        number = np.zeros(int(segmentation.mask.max()) + 1, dtype=np.int32)
        number[ids] = np.arange(1, len(ids) + 1)  # the model is told that they run from 1 to n
        labels = {k: segmentation.labels[own] for k, own in enumerate(ids, 1)}
        sheet = numbered_sheet(build_scene(image, Segmentation(number[segmentation.mask], labels)))
        names = name_segments(encode_image(sheet), len(ids), self.client)
        return {ids[k - 1]: name for k, name in names.items()}


def offer_suggesters() -> None:
    """Register the suggesters of this module under names that are still free.

    The model is the automatic choice where its SDK is installed and credentials are set, as for translators.
    """
    for name, available in (("anthropic", _ready), ("llm-replay", lambda: False)):
        if name not in suggester_names():
            register_suggester(name, _maker(name), available)


def _maker(name: str) -> Callable[[], VisionSuggester]:
    return lambda: VisionSuggester(name, make_client(name, LlmSettings.from_environment()))


def _ready() -> bool:
    return has_credentials() and find_spec("anthropic") is not None
