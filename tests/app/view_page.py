#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the page of `novelview view` in headless Chromium as a person would, and says what is wrong.

usage: view_page.py PROGRAM DATASET FOLDER [SCREENSHOT]; exit code 77 when there is no browser
"""
import base64
import pathlib
import signal
import subprocess
import sys
import time

from browser import check_requests, expect, finish, open_browser
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

import cv2
import numpy

PROGRAM, DATASET, FOLDER = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
METHOD = ["--hull-spacing", "4"]


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
    check_shows(driver)
    check_panel(driver)
    check_path(driver)
    if len(sys.argv) > 4:
        driver.save_screenshot(sys.argv[4])
    check_touch(driver)
    origin = address.split("/?")[0]
    # The browser reports a replaced picture's answer, 409, itself.
    check_requests(driver, lambda url: url.startswith((origin, "blob:" + origin, "data:")),
                   lambda message: "409" in message or "favicon" in message)


def check_shows(driver):
    """Depth and mesh in place of colours."""
    pictures = [saved(driver)[0]]
    for what in ("depth", "mesh"):
        Select(driver.find_element(By.ID, "show")).select_by_visible_text(what)
        wait_still(driver)
        pictures.append(saved(driver)[0])
    expect(len(set(pictures)) == 3, "depth, mesh and colours look the same")
    Select(driver.find_element(By.ID, "show")).select_by_visible_text("colour")
    wait_still(driver)
    expect(saved(driver)[0] == pictures[0], "the colours are not the same as before")


def check_panel(driver):
    """Nearest photographs, rig, pivot."""
    buttons = driver.find_elements(By.CSS_SELECTOR, "#nearest button")
    WebDriverWait(driver, 20).until(lambda d: all(
        button.find_element(By.TAG_NAME, "img").get_property("naturalWidth") > 0 for button in buttons))
    expect(len(buttons) == 3, "there are not three nearest photographs")
    expect(len(driver.find_elements(By.CSS_SELECTOR, "#rig circle")) == 9, "the rig lacks cameras")
    buttons[1].click()
    wait_still(driver)
    expect(", 0°" in driver.find_element(By.CSS_SELECTOR, "#nearest button").text,
           "a click on a photograph does not go to its camera")
    driver.find_elements(By.CSS_SELECTOR, "#rig circle")[0].click()
    wait_still(driver)
    expect(driver.find_element(By.ID, "cameras").get_property("selectedIndex") == 0,
           "a click on a camera of the rig does not go there")
    before = driver.execute_script("return scene.target")
    picture = driver.find_element(By.ID, "picture")
    ActionChains(driver).move_to_element(picture).double_click().perform()
    WebDriverWait(driver, 20).until(lambda d: "pivot: " in d.find_element(By.ID, "status").text)
    pivot = driver.execute_script("return scene.target")
    expect(pivot != before, "a double click does not move the pivot")
    # It lies on the ray of the pixel, which is the middle of the picture.
    u, v = driver.execute_script(
        "const p = times(camera.R, scene.target).map((x, i) => x + camera.T[i]);"
        "return [camera.K[0] * p[0] / p[2] + camera.K[2], camera.K[4] * p[1] / p[2] + camera.K[5]]")
    expect(abs(u - 79.5) < 2 and abs(v - 59.5) < 2, f"the pivot is at pixel {u}, {v}")
    driver.find_element(By.ID, "pivot").click()
    expect(driver.execute_script("return scene.target") == before, "the pivot is not reset")


def check_path(driver):
    """The recorded path is one that `orbit` takes."""
    picture = driver.find_element(By.ID, "picture")
    for key in ("k", Keys.ARROW_LEFT, "k", Keys.ARROW_UP, "k"):
        picture.send_keys(key)
    rows = driver.find_elements(By.CSS_SELECTOR, "#keys li")
    expect(len(rows) == 3, f"{len(rows)} keys instead of 3")
    rows[1].find_elements(By.TAG_NAME, "button")[1].click()
    expect(len(driver.find_elements(By.CSS_SELECTOR, "#keys li")) == 2, "a key is not deleted")
    (FOLDER / "cameras.json").write_text(driver.execute_script("return pathFile()"))
    # Videos have a softer boundary than pictures unless told otherwise.
    subprocess.run([PROGRAM, "orbit", DATASET, "--path", FOLDER / "cameras.json", "--frames", "2",
                    "--out", FOLDER / "frames", "--quiet", "--boundary-samples", "3",
                    "--no-soft-boundary", *METHOD], check=True)
    wait_still(driver)
    last = cv2.imdecode(numpy.frombuffer(saved(driver)[0], numpy.uint8), cv2.IMREAD_COLOR)
    expect((cv2.imread(str(FOLDER / "frames/frame_0001.png")) == last).all(),
           "the last frame of the path is not the page's picture")


def check_touch(driver):
    """Two fingers that part: the camera comes nearer."""
    before = driver.execute_script("return Math.hypot(...centre())")
    driver.execute_script("""
        const box = picture.getBoundingClientRect(), y = box.top + 50;
        const send = (type, id, x) => picture.dispatchEvent(new PointerEvent(type,
          { pointerId: id, pointerType: "touch", clientX: box.left + x, clientY: y, bubbles: true }));
        picture.setPointerCapture = () => {};
        send("pointerdown", 11, 60); send("pointerdown", 12, 80);
        send("pointermove", 12, 110); send("pointermove", 11, 40);
        send("pointerup", 11, 40); send("pointerup", 12, 110);""")
    wait_still(driver)
    after = driver.execute_script("return Math.hypot(...centre())")
    expect(after < .6 * before, f"two fingers zoom from {before} to {after}")


def main():
    driver = open_browser("1000,900")
    program = subprocess.Popen([PROGRAM, "view", DATASET, "--no-open", *METHOD],
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
    finish()


main()
