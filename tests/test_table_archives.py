"""The archive of texts that a phone app exports: each text is a sheet of its own."""

import io
import zipfile

from test_table import refused

from kalman_lib.data import read_table


def phone_app(**texts):
    """The .zip of a phone app: its CSVs, and what phyphox and macOS add."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as parts:
        for name, text in texts.items():
            parts.writestr(f"{name}.csv", text)
        parts.writestr("meta/device.csv", "property,value\nversion,1\n")
        parts.writestr("__MACOSX/._Pressure.csv", "1;2\n3;4\n")
    return content.getvalue()


PRESSURE = "\ufeffTime (s),Pressure (hPa)\n" + "".join(f"{k / 2},{1000 - k}\n" for k in range(12))
LIGHT = "Time (s);Illuminance (lx)\n0;1,5\n1;2,5\n2;3,5\n"


def test_the_archive_of_a_phone_app_is_a_table_a_sheet(tmp_path):
    content = phone_app(Pressure=PRESSURE, Light=LIGHT, Empty="")
    table = read_table(content)
    assert table.sheets == ("Pressure.csv", "Light.csv") and table.sheet == "Pressure.csv"
    assert table.time == "Time (s)" and table.columns[table.value].tolist()[:2] == [1000, 999]
    (tmp_path / "run.zip").write_bytes(content)
    light = read_table(str(tmp_path / "run.zip"), sheet="Light.csv")
    assert light.columns[light.value].tolist() == [1.5, 2.5, 3.5] and light.decimal == ","


def test_an_archive_without_a_table_or_with_too_much_is_refused():
    assert "is an archive, but not an Excel" in refused(phone_app())[0]
    assert "no column of numbers" in refused(phone_app(Words="a\nb\n"))[0]
    huge = "1\n" * 4_100_000
    assert "17 MB are too much" in refused(phone_app(a="1" * 17_000_000))[0]
    assert "rows are too many" in refused(phone_app(a=huge))[0]
