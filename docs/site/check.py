"""Walks through the site as a reader does, from its first page on, and says what leads nowhere: pages, places in pages, pictures, and pages
that nobody reaches. Ends with one line of counts.

    check.py FOLDER
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

SITE = Path(sys.argv[1]).resolve()
# What mdbook makes beside the pages.
MADE = {"print.html", "404.html", "toc.html"}


class Page(HTMLParser):
    """Where a page leads, and which places it has."""

    def __init__(self, path):
        super().__init__()
        self.links, self.places, self.shown = [], set(), []
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.places |= {of[key] for key in ("id", "name") if of.get(key)}
        for key in ("href", "src"):
            if of.get(key):
                (self.links if tag == "a" else self.shown).append(of[key])


def led(page, link):
    """The file that a link of a page leads to, and the place in it; None out of the site."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
    return (target / "index.html" if target.is_dir() else target), unquote(parts.fragment)


def main():
    pages = {path: Page(path) for path in SITE.rglob("*.html") if path.name not in MADE}
    wrong, checked = [], 0
    reached, waiting = set(), [SITE / "index.html"]
    # The list at the side is a page of its own.
    at_side = {led(SITE / "toc.html", link)[0] for link in Page(SITE / "toc.html").links}
    while waiting:
        path = waiting.pop()
        if path in reached:
            continue
        reached.add(path)
        for link in [*pages[path].links, *pages[path].shown]:
            found = led(path, link)
            if found is None:
                continue
            checked += 1
            target, place = found
            name = path.relative_to(SITE)
            if not target.exists():
                wrong.append(f"{name}: {link} leads nowhere")
            elif target in pages:
                if place and place not in pages[target].places:
                    wrong.append(f"{name}: {link} names no place of that page")
                waiting.append(target)
    for path in sorted(set(pages) - reached):
        wrong.append(f"{path.relative_to(SITE)} is reached from no page")
    for path in sorted(set(pages) - at_side - {SITE / "index.html"}):
        wrong.append(f"{path.relative_to(SITE)} is not in the list at the side")
    print("\n".join(wrong[:60]))
    print(f"{len(pages)} pages, {checked} links")
    print(f"{checked + len(pages) - len(wrong)} passed, {len(wrong)} failed, 0 skipped")
    sys.exit(1 if wrong else 0)


main()
