"""What Sphinx lacks for Indonesian: a search language and the words of citations and
bibliographies.

The texts of the theme are in book/_locale/id/LC_MESSAGES: sphinx.po for what the build writes,
sphinx.js for what the search page writes in the browser."""

import dataclasses

from pybtex.plugin import register_plugin as register_pybtex
from pybtex.style.formatting.unsrt import Style
from pybtex.style.template import field, optional, words
from sphinx.search import SearchLanguage
from sphinxcontrib.bibtex.plugin import register_plugin as register_referencing
from sphinxcontrib.bibtex.style.referencing import PersonStyle
from sphinxcontrib.bibtex.style.referencing.author_year import AuthorYearReferenceStyle
from texts import choose


class SearchIndonesian(SearchLanguage):
    """Words are found as they are written: a simple stemmer would miss Indonesian prefixes."""

    lang = "id"
    language_name = "Indonesian"
    stopwords = set(
        """
        ada adalah agar akan aku anda antara apa apabila apakah atau bagai bagaimana bagi bahwa
        banyak baru beberapa begitu belum berupa bila bisa boleh bukan cara cukup dalam dan dapat
        dari daripada demikian dengan di dia dua hal hanya harus hingga ia ialah ini itu jadi jika
        juga kah kalau kami kamu karena ke kecil kembali kemudian kepada kita lah lagi lain lalu
        lebih maka makin masih melainkan mereka misalnya namun nya oleh pada paling para pula pun
        saat saja sama sampai sangat satu saya sebab sebagai sebelum sebuah secara sedang sehingga
        sejak selain selalu semua seorang seperti serta sesuatu setelah setiap suatu sudah supaya
        tanpa tapi telah tentang tentu terhadap tetapi tiap tidak untuk yaitu yakni yang
    """.split()
    )


WORDS = {
    "In": "Dalam",
    "in": "dalam",
    "of": "dari",
    "editor": "penyunting",
    "editors": "penyunting",
    "volume": "volume",
    "Number": "Nomor",
    "number": "nomor",
    "chapter": "bab",
    "pages": "hlm.",
    "Master's thesis": "Tesis magister",
    "PhD thesis": "Disertasi doktor",
    "Technical Report": "Laporan teknis",
    " (visited on ": " (diakses ",
}


def translate(template):
    """Replace the English words of a pybtex template, which is a tree whose leaves are strings."""
    if isinstance(template, str):
        return WORDS.get(template, template)
    if isinstance(template, (list, tuple)):
        return [translate(part) for part in template]
    if hasattr(template, "children"):
        template.children = [translate(part) for part in template.children]
        for name, value in (getattr(template, "kwargs", None) or {}).items():
            if isinstance(value, str):
                template.kwargs[name] = value.replace(" and ", " dan ")
    return template


class EnglishStyle(Style):
    """The bibliography style `unsrt`, in the order of the authors."""

    default_sorting_style = "author_year_title"


def choose_fields(app):
    """Fields and authors of references.bib may be written "Indonesia | English", too."""
    language = app.config.language
    for entry in app.env.get_domain("cite").bibdata.data.entries.values():
        for name, value in list(entry.fields.items()):
            entry.fields[name] = choose(value, language)
        for person in entry.persons.get("author", []):
            names = [name.strip("{}") for name in person.last_names]
            person.last_names = [choose(name, language) for name in names]


class IndonesianStyle(EnglishStyle):
    """The same with Indonesian words."""

    def format_edition(self, e):
        return optional[words["edisi", field("edition", apply_func=lambda text: text.lower())]]

    def format_entry(self, label, entry, bib_data=None):
        name = f"get_{entry.type}_template"
        english = getattr(super(), name)
        setattr(self, name, lambda *args: translate(english(*args)))
        return super().format_entry(label, entry, bib_data)


@dataclasses.dataclass
class IndonesianReferences(AuthorYearReferenceStyle):
    """(Welch dan Bishop, 2006) instead of (Welch and Bishop, 2006)."""

    person: PersonStyle = dataclasses.field(
        default_factory=lambda: PersonStyle(sep2=" dan ", last_sep=", dan ", other=" dkk.")
    )


def choose_citation_words(app, config):
    indonesian = config.language == "id"
    register_pybtex(
        "pybtex.style.formatting",
        "book",
        IndonesianStyle if indonesian else EnglishStyle,
        force=True,
    )
    register_referencing(
        "sphinxcontrib.bibtex.style.referencing",
        "book",
        IndonesianReferences if indonesian else AuthorYearReferenceStyle,
        force=True,
    )


def setup(app):
    app.add_search_language(SearchIndonesian)
    app.connect("builder-inited", choose_fields, priority=900)  # when the .bib file has been read
    app.connect("config-inited", choose_citation_words, priority=100)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
