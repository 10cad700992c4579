#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a report in headless Chromium, uses it as a reader would, and says what is wrong.

usage: report_page.py REPORT.html FOLDER_OF_THE_RUN; exit code 77 when there is no browser to do it with
"""
import csv
import json
import pathlib
import sys

from browser import check_requests, expect, finish, open_browser
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


def table_values(driver, name):
    """Rows of a table of the page, every number with all its digits; None where there is none."""
    rows = []
    for row in driver.find_elements(By.CSS_SELECTOR, f"#{name} tbody tr"):
        cells = row.find_elements(By.CSS_SELECTOR, "th, td")
        values = [cell.get_attribute("data-value") for cell in cells]
        rows.append([None if value is None else float(value) for value in values])
    return rows


def check_tables(driver, folder):
    for step in ("outline", "nonoutline"):
        with open(folder / f"rms_{step}.csv", newline="") as file:
            expected = [[None if cell == "" else float(cell) for cell in row]
                        for row in list(csv.reader(file))[1:]]
        expect(len(expected) > 1, f"rms_{step}.csv has no rows")
        expect(table_values(driver, f"table-{step}") == expected, f"table {step} is not the CSV's")
    stages = json.loads((folder / "summary.json").read_text())["stages"]
    expected = [[None] + list(scores.values()) for scores in stages.values()]
    expect(table_values(driver, "table-stages") == expected, "table of stages is not the JSON's")
    data = json.loads(driver.find_element(By.ID, "report-data").get_attribute("textContent"))
    expect(data["summary"]["stages"] == stages, "data block has other scores")
    expect(data["job"] == json.loads((folder / "job.json").read_text()), "data has another job")
    seconds = [[None, value] for value in data["timings"]["stages"].values()]
    expect(table_values(driver, "table-timings") == seconds, "table of timings is not the data's")
    expect(data["timings"]["threads"] > 0 and data["timings"]["peakMemoryMiB"] > 0,
           "threads or memory missing")
    expect("OpenGL" in driver.find_element(By.ID, "about").text, "no renderer is named")


def check_comparison(driver):
    box = driver.find_element(By.ID, "compare")
    slider = box.find_element(By.CSS_SELECTOR, "input[type=range]")
    above = box.find_elements(By.CSS_SELECTOR, ".stack img")[1]
    before = above.value_of_css_property("clip-path")
    for _ in range(10):
        slider.send_keys(Keys.ARROW_RIGHT)
    expect(slider.get_attribute("value") == "60", "ten arrow keys do not move the slider by ten")
    after = above.value_of_css_property("clip-path")
    expect(before != after and "40%" in after, f"the slider does not cut: {before} to {after}")
    for label in box.find_elements(By.TAG_NAME, "label"):
        expect(label.text.strip() != "", "a control has no label")
    choices = box.find_elements(By.TAG_NAME, "select")
    names = [option.text for option in choices[0].find_elements(By.TAG_NAME, "option")]
    for name in ("hull", "outline", "full", "truth", "error of full"):
        expect(name in names, f"{name} cannot be chosen")
    source = above.get_attribute("src")
    choices[0].send_keys("truth")
    expect(above.get_attribute("src") != source, "the choice does not change the picture")
    shown = driver.execute_script(
        "return [...document.images].every(i => i.complete && i.naturalWidth > 0)")
    expect(shown, "a picture does not decode")


def check_player(driver, folder):
    box = driver.find_element(By.ID, "player")
    slider = box.find_element(By.CSS_SELECTOR, "input[type=range]")
    image = box.find_element(By.CSS_SELECTOR, ".screen img")
    caption = box.find_element(By.CSS_SELECTOR, ".screen figcaption")
    frames = len(list((folder / "iterations").glob("*outline_??.png")))
    expect(slider.get_attribute("max") == str(frames - 1), "not a frame per iteration")
    first = (image.get_attribute("src"), caption.text)
    slider.send_keys(Keys.END)
    last = (image.get_attribute("src"), caption.text)
    expect(first[0] != last[0] and first[1] != last[1], "the player shows the same at its end")
    box.find_element(By.CSS_SELECTOR, "button[aria-label^=Previous]").click()
    expect(slider.get_attribute("value") == str(frames - 2), "the button does not go back")
    play = box.find_element(By.TAG_NAME, "button")
    play.click()
    moved = driver.execute_async_script("""
        const [slider, done] = arguments, from = slider.value;
        const end = Date.now() + 5000;
        (function look() {
          slider.value !== from ? done(true) : Date.now() > end ? done(false) : setTimeout(look, 50);
        }());""", slider)
    expect(moved, "playing does not go on")
    play.click()
    expect(play.get_attribute("aria-pressed") == "false", "playing does not stop")
    tracks = box.find_elements(By.CSS_SELECTOR, "select option")
    if any((folder / "iterations").glob("*_desktop.png")):
        expect([track.text for track in tracks] == ["novel view", "scene"], "no scene to choose")


def check_paper(driver, folder):
    """The section in the form of the paper: figures, tables 1 to 4, the row of iterations."""
    section = driver.find_element(By.ID, "paper")
    galleries = section.find_elements(By.CSS_SELECTOR, ".gallery")
    names = [[figure.get_attribute("data-name").split(",")[0]
              for figure in gallery.find_elements(By.TAG_NAME, "figure")] for gallery in galleries]
    expect(names[0] == ["hull", "outline", "full", "truth"], f"figure 14 shows {names[0]}")
    expected = ["initial mesh", "culled"]
    for step, name in (("outline", "outline"), ("nonoutline", "non-outline")):
        with open(folder / f"rms_{step}.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        times = [int(row["iteration"]) for row in rows]
        expected += [f"{name} {i}" for i in times if i in (1, 2, 5, 10) or i and i == times[-1]]
        expect(table_values(driver, f"table-paper-{step}") ==
               [[None] + [float(row["rms"]) for row in rows]], f"paper's table of {step} is not the CSV's")
    expect(names[1] == expected + ["truth"], f"the row of iterations shows {names[1]}")


def check_without_script(page):
    """Everything can still be seen and read."""
    driver = open_browser(
        "1280,1200", {"profile.managed_default_content_settings.javascript": 2})
    try:
        driver.get(page.as_uri())
        expect(not driver.find_elements(By.CSS_SELECTOR, "input[type=range]"), "script runs after all")
        for selector in ("#compare figure img", "#player li img", "#table-outline", "#photographs img"):
            found = driver.find_elements(By.CSS_SELECTOR, selector)
            expect(found and all(each.is_displayed() for each in found), f"{selector} is not shown")
    finally:
        driver.quit()


def main(page, folder):
    driver = open_browser("1280,1200")
    try:
        driver.get(page.as_uri())
        check_tables(driver, folder)
        check_comparison(driver)
        check_player(driver, folder)
        check_paper(driver, folder)
        expect(driver.execute_script("return window.injected === undefined"),
               "a name in the page was run as script")
        check_requests(
            driver, lambda address: address == page.as_uri() or address.startswith("data:"))
    finally:
        driver.quit()
    check_without_script(page)
    finish()


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
