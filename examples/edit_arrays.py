"""Edit a picture that exists only in memory: draw a lamp, then ask for a change.

Run: python examples/edit_arrays.py
"""

import numpy as np

from iconjax import edit

mask = np.zeros((256, 256), np.uint8)
mask[40:110, 70:170] = 1
mask[110:200, 112:128] = 2
mask[200:224, 40:216] = 3
colours = np.array([[255, 255, 255], [230, 160, 40], [90, 90, 90], [120, 70, 40]], np.uint8)

result = edit(
    colours[mask],
    mask,
    "Make the lamp's shade half as wide",
    labels={1: "Lamp:Shade", 2: "Lamp:Foot", 3: "Table"},
)
print(result.explain())
result.save("edited.png")
