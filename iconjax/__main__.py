"""`python -m iconjax` is the command `iconjax`."""

from iconjax.cli import main

main(prog_name="iconjax")
