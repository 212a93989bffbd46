"""Every small input of table_cases.py is read, or refused, as a person would."""

import numpy as np
import pytest
from table_cases import READ, options_of
from table_refused import REFUSED

from kalman_lib.data import InputError, read_table


@pytest.mark.parametrize("text, columns, more", READ, ids=lambda value: repr(value)[:40])
def test_it_is_read_as_a_person_would(text, columns, more):
    table = read_table(text, **options_of(more))
    assert list(table.columns) == list(columns)
    for name, values in columns.items():
        np.testing.assert_allclose(table.columns[name], values, rtol=1e-12, err_msg=name)
    for role in ("time", "value"):
        assert getattr(table, role) == more.get(role, getattr(table, role))
    assert {name: table.units.get(name) for name in more.get("units", {})} == more.get("units", {})
    assert more.get("en", "") in table.note["en"]
    assert table.note["id"] != table.note["en"]


@pytest.mark.parametrize("text, options, en, id", REFUSED, ids=lambda value: repr(value)[:40])
def test_it_is_refused_in_one_sentence(text, options, en, id):
    with pytest.raises(InputError) as error:
        read_table(text, **options)
    assert en in error.value.en and id in error.value.id
