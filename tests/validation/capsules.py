"""What the cases with a spherical capsule in shear flow share."""
from membranes import Sheared
from suite import TUTORIALS

BOX = (8, 6, 8)  # radii, along the flow, the vorticity and the gradient
STRAIN = 5


class Capsules(Sheared):
    """law: settings of the membrane, if other than the tutorial's. values: of Ca, or of the varied parameter. boxes: of a
    value, by the resolution from which on they apply, where they are not BOX."""

    def __init__(self, name, values, law=(), boxes={}, **varied):
        super().__init__(name, TUTORIALS / "capsuleShear", {value: (STRAIN, {6: BOX, **boxes.get(value, {})}) for value in values}, law, **varied)
