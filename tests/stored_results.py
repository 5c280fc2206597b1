"""Files of results with other contents and right checksums, as a hostile hand writes them."""

import io
import json

from scipy.io import netcdf_file

from exu_press.result.netcdf import write_checksums


def rewritten(content, texts=None, variables=None):
    """Return a file with other texts and variables.

    Args:
        content: of the file.
        texts: other texts by name, or None for none.
        variables: by name what is another thing: name (None: no variable), dimensions, values,
            units or long_name.
    """
    made = io.BytesIO()
    with (
        netcdf_file(io.BytesIO(content), mmap=False) as old,
        netcdf_file(made, "w", version=2) as new,
    ):
        for name, text in {**old._attributes, **(texts or {})}.items():
            if name != "checksum" and text is not None:
                setattr(new, name, text)
        for name, length in old.dimensions.items():
            new.createDimension(name, length)
        for name, variable in old.variables.items():
            kept = {"name": name, "dimensions": variable.dimensions, "values": variable[:].copy()}
            kept |= {key: variable._attributes.get(key) for key in ("units", "long_name")}
            kept |= (variables or {}).get(name, {})
            if kept["name"] is None:
                continue
            values = kept["values"]
            copied = new.createVariable(kept["name"], values.dtype.char, kept["dimensions"])
            copied[:] = values
            for attribute in ("units", "long_name"):
                if kept[attribute] is not None:
                    setattr(copied, attribute, kept[attribute])
        write_checksums(new)
        new.flush()
        return made.getvalue()


def text_of(content, name):
    """Return what a text of a file says."""
    with netcdf_file(io.BytesIO(content), mmap=False) as file:
        return json.loads(getattr(file, name))
