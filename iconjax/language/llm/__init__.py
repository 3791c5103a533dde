"""The request read by a large language model, over any server that speaks the Messages API."""
