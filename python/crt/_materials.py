"""An entity gets a material of either kind."""

from typing import Any

from ._library import create
from ._structs import reference
from .errors import named
from .values import Material, PrincipledMaterial

AnyMaterial = Material | PrincipledMaterial


def dressed(entity: Any, material: AnyMaterial, argument: str) -> tuple[Any, AnyMaterial]:
    """Returns the handle of an entity that has the material, and what it keeps of that."""
    is_principled = isinstance(material, PrincipledMaterial)
    given = reference(material, "crt_principled" if is_principled else "crt_material", argument)
    function = "crt_entity_with_principled" if is_principled else "crt_entity_with_material"
    with named(argument):
        handle = create(function, entity, given)
    return handle, material._snapshot("an entity keeps a material of its own")
