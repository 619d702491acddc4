"""Candela: lighting models as plugins.

>>> import candela
>>> scene = candela.Scene.load("scene.toml")
>>> picture = scene.render()                  # a NumPy array, (height, width, 3), of uint8

Directions are unit vectors, lengths metres, angles degrees; y is up. See docs/user/python.md.
"""

from ._candela import __version__
from .checks import Check, conformance
from .errors import Diagnostic, Error, RequestError, SceneError
from .instances import Incident, Light, Reflected, Reflection, Shading, light, reflection, shading
from .kernels import kernel_reflection
from .measured import MeasuredBrdf, read_merl
from .picture import Picture
from .registry import Model, Parameter, Registry, model, models
from .scene import Explanation, Renderer, Scene, document

__all__ = [
    "Check", "Diagnostic", "Error", "Explanation", "Incident", "Light", "MeasuredBrdf", "Model", "Parameter", "Picture", "Reflected",
    "Reflection", "Registry", "Renderer", "RequestError", "Scene", "SceneError", "Shading", "__version__", "conformance", "document",
    "kernel_reflection", "light", "model", "models", "read_merl", "reflection", "shading",
]
