"""Screenshots of a report for the gallery: screenshots.py REPORT.html FOLDER."""

import os
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import chromium  # noqa: E402


def main():
    page, folder = sys.argv[1:3]
    if not chromium.find():
        print("screenshots: there is no chromium, the old ones stay")
        return
    with chromium.Browser(1400, 900) as browser:
        for theme in ("light", "dark"):
            browser.dark(theme == "dark")
            browser.open(page)
            browser.wait_for("document.documentElement.dataset.state === 'drawn'")
            browser.value("spaces[0].card.scrollIntoView({block: 'center'})")
            browser.wait_for("spaces[0].frames > 3")
            browser.value("spaces[0].playButton.click(); spaces[0].at = 0.45 * spaces[0].length; spaces[0].show()")
            time.sleep(0.3)
            browser.screenshot(os.path.join(folder, f"space_{theme}.png"), browser.box("[id^=space]"))
            browser.value("scrollTo(0, 0)")
            time.sleep(0.2)
            browser.screenshot(os.path.join(folder, f"report_{theme}.png"))


main()
