"""iconjax: edit an icon by a sentence.

`edit` does the whole job; the other public names are loaded when first used, so that `import iconjax` is
quick, imports no JAX and touches no network.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

# Imported eagerly, and it is light: the function has to win the name `iconjax.edit` over the folder of that
# name, which it does because the folder is imported by the time this line binds the function.
from iconjax.edit.api import edit as edit

if TYPE_CHECKING:
    from iconjax.edit.choose import register_translator as register_translator
    from iconjax.edit.config import EditConfig as EditConfig
    from iconjax.edit.result import EditResult as EditResult
    from iconjax.errors import ConfigError as ConfigError
    from iconjax.errors import IconjaxError as IconjaxError
    from iconjax.errors import InputError as InputError
    from iconjax.errors import ProgramError as ProgramError
    from iconjax.errors import TranslationError as TranslationError
    from iconjax.scene.types import Segmentation as Segmentation

__version__ = "0.1.0"

_HOME = {
    "ConfigError": "iconjax.errors",
    "EditConfig": "iconjax.edit.config",
    "EditResult": "iconjax.edit.result",
    "IconjaxError": "iconjax.errors",
    "InputError": "iconjax.errors",
    "ProgramError": "iconjax.errors",
    "Segmentation": "iconjax.scene.types",
    "TranslationError": "iconjax.errors",
    "register_translator": "iconjax.edit.choose",
}

__all__ = ["__version__", "edit", *_HOME]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'iconjax' has no attribute {name!r}")
    value = getattr(import_module(_HOME[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
