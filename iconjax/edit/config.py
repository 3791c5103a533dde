"""Settings of an edit, checked when they are made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from difflib import get_close_matches
from types import MappingProxyType
from typing import Any

from iconjax.errors import ConfigError
from iconjax.search.config import STRATEGIES, SearchConfig


@dataclass(frozen=True)
class EditConfig:
    """How an edit is searched for.

    Attributes:
        strategy: "coherent" (the default: change as little as possible, keep the picture coherent) or "paper"
            (the published algorithm).
        relation_search: whether secondary constraints may be loosened; off is the paper's ablation.
        motion_search: whether motion states may change; off is the paper's ablation.
        solver: name of the method that minimises a candidate's loss; "" is the strategy's own.
        search: any further fields of `iconjax.search.config.SearchConfig`, by name, for experiments.

    Raises:
        ConfigError: an unknown name or a value that is not allowed; the message names what is.
    """

    strategy: str = "coherent"
    relation_search: bool = True
    motion_search: bool = True
    solver: str = ""
    search: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.strategy not in STRATEGIES:
            raise ConfigError(f"strategy is {self.strategy!r}; it can be {' or '.join(map(repr, STRATEGIES))}")
        for name in ("relation_search", "motion_search"):
            if not isinstance(getattr(self, name), bool):
                raise ConfigError(f"{name} is {getattr(self, name)!r}; it can be True or False")
        if not isinstance(self.solver, str):
            raise ConfigError(f"solver is {self.solver!r}; it has to be a name")
        if not isinstance(self.search, Mapping):
            raise ConfigError(f"search is a {type(self.search).__name__}; it has to be a mapping of names to values")
        object.__setattr__(self, "search", MappingProxyType(dict(self.search)))
        self.to_search()

    def to_search(self) -> SearchConfig:
        """The settings as the search takes them."""
        own = [f.name for f in fields(self)]
        further = [f.name for f in fields(SearchConfig) if f.name not in own]
        for name in self.search:
            if name in own:
                raise ConfigError(f"search holds {name!r}; give {name}= to EditConfig itself")
            if name not in further:
                close = get_close_matches(str(name), further, 1)
                hint = f"did you mean {close[0]!r}?" if close else f"it can hold {', '.join(further)}"
                raise ConfigError(f"search holds {name!r}; {hint}")
        return SearchConfig(
            strategy=self.strategy,
            relation_search=self.relation_search,
            motion_search=self.motion_search,
            solver=self.solver,
            **self.search,
        )
