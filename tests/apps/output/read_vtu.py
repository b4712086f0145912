"""Prints the arrays of a .vtu file, a line each: name, number of components, values as Python writes them.

Decodes the file by itself; where meshio is installed it must find the same points and point data.
"""

import base64
import struct
import sys
import xml.etree.ElementTree

FORMATS = {"Float64": "d", "Int64": "q", "UInt8": "B"}


def values_of(array):
    data = base64.b64decode(array.text.strip(), validate=True)
    (size,) = struct.unpack_from("<Q", data)
    letter = FORMATS[array.get("type")]
    assert size == len(data) - 8, "the size in the header is not that of the data"
    return list(struct.unpack_from(f"<{size // struct.calcsize(letter)}{letter}", data, 8))


def check_with_meshio(file, arrays):
    try:
        import meshio
    except ImportError:
        return "without meshio"
    mesh = meshio.read(file)
    assert mesh.points.ravel().tolist() == arrays["Points"]
    for name, values in mesh.point_data.items():
        assert values.ravel().tolist() == arrays[name], name
    return f"with meshio, {len(mesh.point_data)} arrays of point data"


root = xml.etree.ElementTree.parse(sys.argv[1]).getroot()
arrays = {}
for array in root.iter("DataArray"):
    arrays[array.get("Name")] = values_of(array)
    print(array.get("Name"), array.get("NumberOfComponents"), *map(repr, arrays[array.get("Name")]))
print("read", check_with_meshio(sys.argv[1], arrays), file=sys.stderr)
