"""The same source, the same bytes: archives and workbooks carry the date of the edition instead of
the minute in which they were made. A reader's copy of the book then fetches only what has changed.
"""

import datetime
import io
import re
import zipfile

from edition import edition

READABLE = 0o644 << 16  # what everybody may do with a file, as an archive notes it
MADE = re.compile(rb"(<dcterms:(?:created|modified)[^>]*>)[^<]*")


def date():
    """The day of the edition."""
    return datetime.date.fromisoformat(edition()["date"])


def add(archive, name, content):
    """A file of the archive, whoever made it and whenever."""
    entry = zipfile.ZipInfo(name, (*date().timetuple()[:3], 0, 0, 0))
    entry.external_attr = READABLE
    entry.create_system = 3  # as under Unix, also where it was made under Windows
    archive.writestr(entry, content, zipfile.ZIP_DEFLATED)


def without_the_minute(workbook):
    """The bytes of an .xlsx -> the same workbook, dated by the edition."""
    day = f"{date().isoformat()}T00:00:00Z".encode()
    made = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(workbook)) as before,
        zipfile.ZipFile(made, "w") as after,
    ):
        for name in before.namelist():
            content = before.read(name)
            if name == "docProps/core.xml":
                content = MADE.sub(rb"\g<1>" + day, content)
            add(after, name, content)
    return made.getvalue()
