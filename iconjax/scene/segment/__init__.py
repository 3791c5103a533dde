"""A first segmentation of a picture that has none: segmenters without a model, and where others plug in."""
