"""Takes a picture of a page of `lamina view`.

usage: screenshot.py FILE.html[#STATE] WIDTHxHEIGHT PICTURE.png
"""

import os
import sys

from browser import Browser


def main():
    page, size, picture = sys.argv[1:]
    width, height = (int(number) for number in size.split("x"))
    browser = Browser(width, height)
    try:
        browser.open("file://" + os.path.abspath(page))
        browser.screenshot(picture)
    finally:
        browser.close()


main()
