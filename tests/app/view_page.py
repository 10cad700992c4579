#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the page of `novelview view` in headless Chromium as a person would, and says what is wrong.

usage: view_page.py PROGRAM DATASET FOLDER [SCREENSHOT]; exit code 77 when there is no browser
"""
import base64
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import time

try:
    import cv2
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    sys.exit(77)

PROGRAM, DATASET, FOLDER = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
METHOD = ["--hull-spacing", "4"]
FAULTS = []


def expect(fits, what):
    if not fits:
        FAULTS.append(what)


def open_browser():
    if not shutil.which("chromedriver"):
        sys.exit(77)
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--window-size=1000,900"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def wait_still(driver):
    """Waits for the full picture of the camera that the page has now."""
    WebDriverWait(driver, 60).until(lambda d: d.execute_script(
        "return camera !== null && picture.dataset.still === String(wanted) && picture.complete"
        " && picture.naturalWidth === camera.width"))


def centre(driver):
    return driver.execute_script("return centre()")


def saved(driver):
    """The bytes of the picture and the camera of the page."""
    data = driver.execute_async_script(
        "const done = arguments[0]; const reader = new FileReader();"
        "reader.onload = () => done(reader.result); reader.readAsDataURL(shown);")
    return base64.b64decode(data.split(",")[1]), driver.execute_script("return camera")


def check_against_render(driver):
    png, camera = saved(driver)
    (FOLDER / "page.png").write_bytes(png)
    numbers = camera["K"] + camera["R"] + camera["T"]
    (FOLDER / "view_par.txt").write_text("1\nview.png " + " ".join(map(repr, numbers)) + "\n")
    subprocess.run([PROGRAM, "render", DATASET, "--cameras", FOLDER / "view_par.txt", "--out",
                    FOLDER / "rendered", "--quiet", *METHOD], check=True)
    ours, theirs = cv2.imread(str(FOLDER / "page.png")), cv2.imread(str(FOLDER / "rendered/view.png"))
    expect(ours.shape == theirs.shape and (ours == theirs).all(),
           "the still picture is not the one of `novelview render`")
    expect((ours.max(axis=2) > 0).mean() > 0.02, "the picture is black")


def use(driver, address):
    driver.set_script_timeout(60)
    driver.get(address)
    wait_still(driver)
    names = [o.text for o in driver.find_elements(By.CSS_SELECTOR, "#cameras option")]
    expect(len(names) == 8, f"cameras: {names}")
    start = centre(driver)
    picture = driver.find_element(By.ID, "picture")
    drag = ActionChains(driver, duration=20).move_to_element(picture).click_and_hold()
    for _ in range(30):
        drag = drag.move_by_offset(1, 0)
    drag.release().perform()
    wait_still(driver)
    dragged = centre(driver)
    moved = sum((a - b) ** 2 for a, b in zip(start, dragged)) ** 0.5
    size = sum(a ** 2 for a in start) ** 0.5
    # Thirty pixels are 0.3 radians, of a circle somewhat smaller than the distance.
    expect(0.1 * size < moved < 0.35 * size, f"a drag moved the camera by {moved / size}")
    check_against_render(driver)
    picture.send_keys(Keys.ARROW_UP)
    wait_still(driver)
    expect(centre(driver) != dragged, "the keyboard does not move the camera")
    picture.send_keys("n")
    wait_still(driver)
    expect(driver.execute_script("return camera.R") != [] and
           driver.find_element(By.ID, "cameras").get_property("selectedIndex") == 1,
           "N does not go to the next photograph's camera")
    check_requests(driver, address)
    if len(sys.argv) > 4:
        driver.save_screenshot(sys.argv[4])


def check_requests(driver, address):
    """Nothing but the program itself may be asked for."""
    origin = address.split("/?")[0]
    for entry in driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            url = message["params"]["request"]["url"]
            expect(url.startswith((origin, "blob:" + origin, "data:")), f"asks for {url[:120]}")
    for entry in driver.get_log("browser"):
        # The browser reports a replaced picture's answer, 409, itself.
        expect("409" in entry["message"] or "favicon" in entry["message"],
               f"console: {entry['message'][:200]}")


def main():
    driver = open_browser()
    program = subprocess.Popen([PROGRAM, "view", DATASET, *METHOD],
                               stdout=subprocess.PIPE, text=True)
    try:
        address = None
        for line in program.stdout:
            if line.startswith("page: "):
                address = line.split()[1]
                break
        use(driver, address)
    finally:
        driver.quit()
        start = time.monotonic()
        program.send_signal(signal.SIGINT)
        program.wait(60)
        print(f"ended after {time.monotonic() - start:.2f} s")
    expect(program.returncode in (0, 130), f"exit code {program.returncode}")
    print("\n".join(FAULTS))
    sys.exit(1 if FAULTS else 0)


main()
