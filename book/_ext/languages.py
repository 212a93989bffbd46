"""Two languages from one source: what Sphinx has to do for it.

The book is built once per language (`language` in the configuration), and this extension drops,
while a page is read, what belongs to the other one. How a text is marked is told in texts.py.
"""

import json
from pathlib import Path

from docutils import nodes
from downloads import download_notebook
from first_cell import on_site
from sphinx.util import logging
from texts import (
    LANGUAGES,
    choose,
    filter_markdown,
    filter_notebook,
    headings,
    source_in,
)

IN_TWO_LANGUAGES = (  # settings
    "html_title",
    "project",
    "author",
    "copyright",
    "html_theme_options",
    "nb_code_prompt_show",
    "nb_code_prompt_hide",
    "book_download_names",
    "togglebutton_hint",
    "togglebutton_hint_hide",
)
MENDED = {
    # myst-nb: its own text says it already
    '<summary aria-label="Toggle hidden content">': "<summary>",
    # docutils: a list without list items
    '<div role="list" class="citation-list">': '<div class="citation-list">',
    ' role="doc-biblioentry"': "",
    # docutils: the corner of a table heads nothing
    '<th class="head"><p></p></th>': "<td></td>",
}
FIRST_PAGE = """<!DOCTYPE html>
<html lang="{language}"><head><meta charset="utf-8">\
<meta name="viewport" content="width=device-width, initial-scale=1"><title>{title}</title>\
<meta http-equiv="refresh" content="0; url={page}.html"></head>
<body><main><h1><a href="{page}.html">{title}</a></h1></main></body></html>
"""
logger = logging.getLogger(__name__)


def split_config(app, config):
    """Choose this language's part of every text in the configuration, theme options included."""
    for name in IN_TWO_LANGUAGES:
        config[name] = split(config[name], config.language)


def split(value, language):
    """Choose in a text, and in all texts of a dict or a list."""
    if isinstance(value, str):
        return choose(value, language)
    if isinstance(value, dict):
        return {key: split(part, language) for key, part in value.items()}
    if isinstance(value, list):
        return [split(part, language) for part in value]
    return value


def split_toc(app, config):
    """The same in the table of contents, which sphinx-external-toc reads at priority 900."""
    for document in config.external_site_map.values():
        document.title = document.title and choose(document.title, config.language)
        for tree in document.subtrees:
            tree.caption = tree.caption and choose(tree.caption, config.language)
            for item in tree.items:
                if not isinstance(item, str) and item.title:  # a link; files are strings
                    item.title = choose(item.title, config.language)


def read_one_language(app, docname, source):
    """Leave only this language in the text of a page; keep the headings for `name_sections`."""
    path = Path(app.env.doc2path(docname))
    app.env.temp_data["english_headings"] = headings(source_in(source[0], path, "en"))
    if path.suffix == ".ipynb":
        source[0] = json.dumps(filter_notebook(json.loads(source[0]), app.config.language))
    else:
        source[0] = filter_markdown(source[0], app.config.language)


def name_sections(app, doctree):
    """Name section n after English heading n: page.html#the-gain is there in both languages."""
    english = app.env.temp_data.get("english_headings", [])
    sections = list(doctree.findall(nodes.section))
    if len(sections) != len(english):
        logger.warning(
            "the page has %d headings, its English text %d: both languages need the same headings "
            "in the same order",
            len(sections),
            len(english),
            location=app.env.docname,
        )
    used = set()
    for section, heading in zip(sections, english):
        slug = free_name(nodes.make_id(heading) or "section", section, used, doctree)
        used.add(slug)
        section["ids"] = [slug] + [old for old in section["ids"] if old != slug]
        doctree.ids[slug] = section
        # a Markdown link page.ipynb#the-gain finds it, too, in both languages
        slugs = app.env.metadata[app.env.docname].setdefault("myst_slugs", {})
        # and so it finds a name that the source gives, such as (bekal-mean)=
        given = [name for name in section["names"] if doctree.nametypes.get(name)]
        for name in (slug, *given):
            slugs[name] = (section.line, slug, section[0].astext())


def free_name(base, section, used, doctree):
    """The name, with a number behind it if another section has it."""
    slug = base
    count = 1
    while slug in used or doctree.ids.get(slug, section) is not section:
        count += 1
        slug = f"{base}-{count}"
    return slug


def add_language_links(app, pagename, templatename, context, doctree):
    """What layout.html and language-switcher.html need to lead to this page in both languages."""
    if app.config.book_site:
        up = "../" * (pagename.count("/") + 1)  # out of this language's folder
        context["languages"] = [
            {"code": code, "name": name, "url": f"{up}{code}/{pagename}.html"}
            for code, name in LANGUAGES.items()
        ]
        context["choose_url"] = f"{up}index.html"


def mend_markup(app, pagename, templatename, context, doctree):
    """Take away what extensions write in English only, or what screen readers stumble over."""
    for wrong, right in MENDED.items():
        context["body"] = context.get("body", "").replace(wrong, right)


def name_downloads(app, pagename, templatename, context, doctree):
    """Say in words what the download menu gives; the theme shows file endings only."""
    names = app.config.book_download_names
    for group in context.get("header_buttons", []):
        for button in group.get("buttons", []):
            text = button.get("text")
            button["text"] = names.get(text, text)


def write_downloads(app, exception):
    """Put this language's texts into _sources, where Sphinx copied those with both."""
    if exception or app.builder.format != "html":
        return
    for docname in app.env.all_docs:
        source = Path(app.env.doc2path(docname))
        copy = Path(app.outdir, "_sources", docname).with_name(source.name)
        if copy.exists():
            text = text_to_download(source, app.config.language, app.config.book_edition)
            copy.write_text(text, encoding="utf-8")


def text_to_download(source, language, edition):
    text = source.read_text(encoding="utf-8")
    if source.suffix != ".ipynb":
        return filter_markdown(text, language)
    place = on_site(edition, language)
    notebook = json.loads(text)
    notebook = download_notebook(notebook, language, source.name, edition["version"], place)
    return json.dumps(notebook, indent=1, ensure_ascii=False)


def write_index(app, exception):
    """index.html of one language leads to its first page."""
    if exception or app.builder.name != "html":
        return
    config = app.config
    values = dict(language=config.language, title=config.html_title, page=config.root_doc)
    Path(app.outdir, "index.html").write_text(FIRST_PAGE.format(**values), encoding="utf-8")


def setup(app):
    # book/build.py sets it, which builds both languages beside each other
    app.add_config_value("book_site", False, "html")
    app.add_config_value("book_download_names", {}, "html")
    app.connect("config-inited", split_config, priority=100)
    app.connect("config-inited", split_toc, priority=999)
    app.connect("source-read", read_one_language)
    # before the table of contents is collected (500)
    app.connect("doctree-read", name_sections, priority=400)
    app.connect("html-page-context", add_language_links)
    app.connect("html-page-context", mend_markup)
    # after the theme has made its buttons
    app.connect("html-page-context", name_downloads, priority=600)
    app.connect("build-finished", write_downloads)
    app.connect("build-finished", write_index, priority=400)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
