"""Policies turn a few weights into smooth joint references (eq. 3-4 of the paper), with numpy only.

kernels = GaussianKernels(kernels=16, variance=0.01)
front = Group(leader=(0, 1, 2), followers=(Follower(joints=(3, 4, 5), signs=(1, 1, 1)),))
hind = Group(leader=(6, 7, 8), followers=(Follower(joints=(9, 10, 11), signs=(1, 1, 1)),))
policy = Policy(kernels, (front, hind), horizon=0.3, timestep=0.002)      # 2 x 3 x 16 = 96 weights
reference = policy.reference(policy.hold(posture)[None])
"""

from levade.policies.ends import Ends
from levade.policies.free import FreeGoal, FreePolicy
from levade.policies.groups import Follower, Group, independent_joints
from levade.policies.kernels import GaussianKernels
from levade.policies.policy import Policy, refine
from levade.policies.protocol import JointPolicy
from levade.policies.slew import Slew
from levade.policies.smoothness import smoothness, smoothness_factor
from levade.policies.tables import policy_from_dict, policy_to_dict

__all__ = [
    "Ends",
    "Follower",
    "FreeGoal",
    "FreePolicy",
    "GaussianKernels",
    "Group",
    "JointPolicy",
    "Policy",
    "Slew",
    "independent_joints",
    "policy_from_dict",
    "policy_to_dict",
    "refine",
    "smoothness",
    "smoothness_factor",
]
