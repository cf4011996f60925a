"""Takes a picture of a page that lamina has written, or serves.

usage: screenshot.py FILE.html[#STATE] WIDTHxHEIGHT PICTURE.png
       screenshot.py http://… WIDTHxHEIGHT PICTURE.png
"""

import os
import sys

from browser import Browser


def main():
    page, size, picture = sys.argv[1:]
    width, height = (int(number) for number in size.split("x"))
    browser = Browser(width, height)
    try:
        browser.open(page if page.startswith("http://")
                     else "file://" + os.path.abspath(page))
        # The studio's solid comes after its layers.
        browser.evaluate("window.studio ? studio.viewer.opened : null")
        browser.settle()
        browser.screenshot(picture)
    finally:
        browser.close()


main()
