"""What the cases with a spherical capsule in shear flow share."""
from membranes import Sheared
from suite import TUTORIALS

BOX = (8, 6, 8)  # radii, along the flow, the vorticity and the gradient
STRAIN = 5


class Capsules(Sheared):
    """law: settings of the membrane, where it is not the tutorial's."""

    def __init__(self, name, capillary, law=()):
        super().__init__(name, TUTORIALS / "capsuleShear", {Ca: (STRAIN, {6: BOX}) for Ca in capillary}, "0.3", law)
