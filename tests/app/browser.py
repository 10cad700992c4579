# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of pages have in common: headless Chromium, and a list of what is wrong.

Importing ends the program with code 77 when there is no browser.
"""
import json
import shutil
import sys

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    sys.exit(77)

FAULTS = []


def expect(fits, what):
    if not fits:
        FAULTS.append(what)


def open_browser(size, preferences=None):
    if not shutil.which("chromedriver"):
        sys.exit(77)
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 f"--window-size={size}"):
        options.add_argument(word)
    if preferences:
        options.add_experimental_option("prefs", preferences)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def check_requests(driver, is_own, is_usual=lambda message: False):
    """The page asks for nothing of others, and the console has no errors but usual ones."""
    for entry in driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            address = message["params"]["request"]["url"]
            expect(is_own(address), f"the page asks for {address[:120]}")
    for entry in driver.get_log("browser"):
        expect(is_usual(entry["message"]), f"console: {entry['message'][:200]}")


def finish():
    """Prints what is wrong and ends the program: code 1 when anything is."""
    print("\n".join(FAULTS))
    sys.exit(1 if FAULTS else 0)
