"""What the cases with a spherical capsule in shear flow share."""
from membranes import Sheared
from suite import TUTORIALS

BOX = (8, 6, 8)  # radii, along the flow, the vorticity and the gradient
STRAIN = 5


class Capsules(Sheared):
    """law: settings of the membrane, where it is not the tutorial's. boxes: of a Ca by resolution, from each on, where they are not BOX."""

    def __init__(self, name, capillary, law=(), boxes={}):
        super().__init__(name, TUTORIALS / "capsuleShear", {Ca: (STRAIN, {6: BOX, **boxes.get(Ca, {})}) for Ca in capillary}, law)
