"""What a page says about itself to those who find, share, mend or cite it.

Everything comes from `book_edition` in _config.yml: address, repository, version, date. Where the
address or the repository is empty, whatever needs it is left out.
"""

from docutils import nodes

LONGEST = 160  # characters of a description, which search engines show whole
SHORTEST = 60  # a shorter paragraph says too little


def describe(app, pagename, templatename, context, doctree):
    """What layout.html and extra-footer.html ask for."""
    edition = app.config.book_edition
    address = edition.get("address", "").rstrip("/")
    language = app.config.language
    context["edition"] = edition
    context["page_description"] = description_of(doctree)
    if address:
        context["page_address"] = f"{address}/{language}/{pagename}.html"
        context["page_picture"] = f"{address}/{language}/_static/vendor/cover.png"
    repository = edition.get("repository", "").rstrip("/")
    if repository and doctree is not None:
        source = app.env.doc2path(pagename, base=False)
        if edition.get("solutions", True):  # the source of a students' edition holds them
            context["edit_url"] = f"{repository}/edit/main/{source}"
        context["issue_url"] = f"{repository}/issues/new?title={pagename}"


def description_of(doctree):
    """The first paragraph that says something, cut at a word."""
    if doctree is None:
        return None
    for paragraph in doctree.findall(nodes.paragraph):
        text = " ".join(paragraph.astext().split())
        if len(text) >= SHORTEST and not isinstance(paragraph.parent, nodes.list_item):
            return shortened(text)
    return None


def shortened(text):
    if len(text) <= LONGEST:
        return text
    return text[:LONGEST].rsplit(" ", 1)[0] + " …"


def setup(app):
    app.add_config_value("book_edition", {}, "env")
    app.connect("html-page-context", describe)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
