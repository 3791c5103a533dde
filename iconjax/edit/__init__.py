"""The whole job, from a picture and a sentence to the edited picture: see `iconjax.edit.api`."""
