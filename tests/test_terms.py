"""Nothing before it is explained: every term of book/terms.yml, along the main path."""

import pytest
import terms_helpers
from terms_helpers import Passage

LANGUAGES = ("id", "en")
LISTED = terms_helpers.glossary.read()
TERMS, NAMES = LISTED["terms"], LISTED["names"]
each_language = pytest.mark.parametrize("language", LANGUAGES)


@each_language
def test_no_term_stands_on_the_main_path_before_it_is_explained(language):
    path = terms_helpers.main_path(language)
    assert terms_helpers.too_early(TERMS, path, language) == []


@each_language
def test_bekal_speaks_of_nothing_that_its_reader_does_not_know(language):
    path, sections = terms_helpers.main_path(language), terms_helpers.ideas(language)
    assert terms_helpers.too_early_in_ideas(TERMS, sections, path, language) == []


@each_language
def test_a_term_stands_where_it_is_said_to_be_explained(language):
    assert terms_helpers.nowhere(TERMS, terms_helpers.everything(language), language) == []


@each_language
def test_no_capitals_stand_anywhere_that_the_list_does_not_know(language):
    passages = terms_helpers.everything(language)
    assert terms_helpers.unknown_capitals(TERMS, NAMES, passages) == {}


@each_language
def test_every_idea_of_bekal_is_linked_from_a_chapter(language):
    notebooks = [p for p in terms_helpers.everything(language) if p.place.startswith("notebooks/")]
    linked = set().union(*(passage.links for passage in notebooks))
    assert {idea.place for idea in terms_helpers.ideas(language)} <= linked


def test_a_term_is_listed_once_and_in_both_languages():
    for language in LANGUAGES:
        names = [term[language].casefold() for term in TERMS]
        assert sorted(names) == sorted(set(names))
        assert all(term["means"][language] for term in TERMS)
    known = {"en", "id", "means", "bekal", "explained", "words", "seen"}
    assert all(set(term) <= known for term in TERMS)
    assert len(TERMS) >= 100 and len(terms_helpers.main_path("en")) >= 100


# --- the tests can fail: small made-up books ----------------------------------------------------

GAIN = {"en": "gain", "id": "penguatan", "explained": "notebooks/01_a#two"}
RMSE = {"en": "RMSE", "id": "RMSE", "bekal": "rmse"}
FILTER = {"en": "EKF", "id": "EKF", "explained": "notebooks/01_a_deeper#one"}
BEKAL_LINK = "[it](../book/bekal.md#bekal-rmse)"


def book(*texts):
    names = ("one", "two", "three")
    return [Passage(f"notebooks/01_a#{name}", text) for name, text in zip(names, texts)]


def early(term, *texts, language="en"):
    return [place for place, _ in terms_helpers.too_early([term], book(*texts), language)]


def test_a_term_may_stand_in_the_cell_that_explains_it_and_later_but_not_before():
    assert early(GAIN, "A bell.", "The **gain** is a share.", "Two gains.") == []
    assert early(GAIN, "Its Gains!", "The gain.", "") == ["notebooks/01_a#one"]
    assert early(GAIN, "Again, $gain$ and `gain`.", "The gain.", "") == []
    assert early(GAIN, "penguatannya", "penguatan", language="id") == ["notebooks/01_a#one"]


def test_a_term_of_bekal_is_known_from_the_first_link_to_its_anchor():
    assert early(RMSE, "The RMSE.", BEKAL_LINK, "RMSE") == ["notebooks/01_a#one"]
    assert early(RMSE, f"{BEKAL_LINK}: RMSE", "RMSE") == []
    assert early(RMSE, "[all](../book/bekal.md)", "RMSE") == ["notebooks/01_a#two"]
    assert early(RMSE, "[all](../book/bekal.md): RMSE", "rmse") == []


def test_a_term_that_nobody_explains_is_too_early_everywhere_but_beside_a_link():
    assert len(early(FILTER, "The EKF.", "EKF", "EKF")) == 3
    assert early(FILTER, "the EKF: [deeper](01_a_deeper.ipynb#any)", "EKF") == [
        "notebooks/01_a#two"
    ]


def test_a_term_with_two_places_is_known_from_the_first_and_must_stand_in_both():
    twice = {**GAIN, "explained": ["notebooks/01_a_deeper#x", "notebooks/01_a#two"]}
    assert early(twice, "gain", "gain", "gain") == ["notebooks/01_a#one"]
    assert early(twice, "gain, [there](01_a_deeper.ipynb)", "gain") == []
    lost = terms_helpers.nowhere([twice], book("", "gain"), "en")
    assert lost == [("gain", "notebooks/01_a_deeper#x")]


def test_an_opening_names_only_what_its_own_chapter_explains():
    path = book("We build a gain, an EKF, the RMSE.", "The gain.", "")
    path[0].announces = ("notebooks/01_a",)
    found = terms_helpers.too_early([GAIN, FILTER, RMSE], path, "en")
    assert [name for _, name in found] == ["EKF", "RMSE"]


def test_an_idea_may_use_what_stands_above_it_or_before_its_first_link():
    sections = [Passage("book/bekal.md#bekal-rmse", "RMSE, gain"), Passage("x#bekal-y", "RMSE")]
    for texts, wrong in ((("gain", "gain", BEKAL_LINK), 0), ((BEKAL_LINK, "gain"), 1)):
        path = book(*texts)
        found = terms_helpers.too_early_in_ideas([GAIN, RMSE], sections, path, "en")
        assert len(found) == wrong


def test_a_place_that_is_lost_or_does_not_hold_its_term_is_named():
    nowhere = terms_helpers.nowhere
    assert nowhere([GAIN], book("", "The gain."), "en") == []
    assert nowhere([GAIN], book("The gain.", "A share."), "en") == [("gain", GAIN["explained"])]
    assert nowhere([GAIN], book("The gain."), "en") == [("gain", GAIN["explained"])]
    assert nowhere([{"en": "gain", "id": "x"}], book("gain"), "en") == [("gain", None)]


def test_new_capitals_are_named_wherever_they_slip_in():
    found = terms_helpers.unknown_capitals([RMSE], ["CSV"], book("RMSE, CSV, $ABC$", "A UKF."))
    assert found == {"UKF": "notebooks/01_a#two"}
