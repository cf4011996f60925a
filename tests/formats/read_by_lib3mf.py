#!/usr/bin/env python3
"""Reads the slices of a .3mf with lib3mf, and prints what read_layers.py does.

    read_by_lib3mf.py <file>

Ends with a message and status 1 where the library fails, warns, or holds the
model for invalid.
"""
import ctypes
import sys

from read_layers import demand, open_loop, print_layers, statistics

library = ctypes.CDLL("lib3MF.so.1")


class Vertex(ctypes.Structure):
    _fields_ = [("x", ctypes.c_float), ("y", ctypes.c_float)]


def call(function, *arguments):
    status = getattr(library, f"lib3mf_{function}")(*arguments)
    demand(status == 0, f"lib3mf_{function} fails: {status & 0xFFFFFFFF:#x}")


def ask(function, *arguments, answer=ctypes.c_uint32):
    """What the function puts in its last argument."""
    result = answer()
    call(function, *arguments, ctypes.byref(result))
    return result if answer is ctypes.c_void_p else result.value


def read_model(path):
    model = ask("createmodel", answer=ctypes.c_void_p)
    reader = ask("model_queryreader", model, b"3mf", answer=ctypes.c_void_p)
    call("reader_readfromfileutf8", reader, path.encode())
    demand(ask("reader_getwarningcount", reader) == 0, "lib3mf warns")
    return model


def only_object(model):
    objects = ask("model_getmeshobjects", model, answer=ctypes.c_void_p)
    demand(ask("resourceiterator_movenext", objects), "no object")
    part = ask("resourceiterator_getcurrent", objects,
               answer=ctypes.c_void_p)
    demand(not ask("resourceiterator_movenext", objects), "many objects")
    demand(ask("object_isvalidobject", part), "no valid object")
    demand(ask("meshobject_ismanifoldandoriented", part), "no closed mesh")
    low_resolution = 1
    demand(ask("meshobject_getslicesmeshresolution", part) == low_resolution,
           "the mesh seems to be the part")
    return part


def read_slice(stack, index):
    piece = ask("slicestack_getslice", stack, ctypes.c_uint32(index),
                answer=ctypes.c_void_p)
    count = ask("slice_getvertexcount", piece)
    vertices = (Vertex * max(count, 1))()
    if count:
        call("slice_getvertices", piece, vertices, ctypes.c_uint32(count))
    loops = []
    for polygon in range(ask("slice_getpolygoncount", piece)):
        number = ctypes.c_uint32(polygon)
        size = ask("slice_getpolygonindexcount", piece, number)
        indices = (ctypes.c_uint32 * size)()
        call("slice_getpolygonindices", piece, number, indices,
             ctypes.c_uint32(size))
        loops.append(open_loop([(vertices[i].x, vertices[i].y)
                                for i in indices]))
    return ask("slice_gettopz", piece, answer=ctypes.c_float), loops


def main():
    model = read_model(sys.argv[1])
    stack = ask("model_getslicestackById", model, ctypes.c_uint32(
        ask("meshobject_getslicestackid", only_object(model))),
        answer=ctypes.c_void_p)
    count = ask("slicestack_getslicecount", stack)
    slices = [read_slice(stack, index) for index in range(count)]
    print_layers((top, statistics(loops)) for top, loops in slices)


if __name__ == "__main__":
    main()
