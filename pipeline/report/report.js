"use strict";
(function () {
  /** A new element with attributes and children (elements or texts). */
  function make(tag, attributes, children) {
    const element = document.createElement(tag);
    for (const name of Object.keys(attributes || {})) {
      element.setAttribute(name, attributes[name]);
    }
    for (const child of children || []) {
      element.append(child);
    }
    return element;
  }

  /** Two of the pictures over each other, cut at a slider. */
  function addComparison(box) {
    const shots = new Map();
    for (const figure of box.querySelectorAll("figure")) {
      shots.set(figure.dataset.name, figure.querySelector("img"));
    }
    if (shots.size < 2) {
      return;
    }
    const names = Array.from(shots.keys());
    const choice = function (label, chosen) {
      const select = make("select", {}, names.map(function (name) {
        return make("option", { value: name }, [name]);
      }));
      select.value = shots.has(chosen) ? chosen : names[0];
      return { select: select, label: make("label", {}, [label, select]) };
    };
    const left = choice("Left", box.dataset.left);
    const right = choice("Right", box.dataset.right);
    const slider = make("input", { type: "range", min: "0", max: "100", step: "1", value: "50" });
    const below = make("img", { alt: "" });
    const above = make("img", { alt: "" });
    const cut = make("div", { "class": "cut" });
    const leftTag = make("span", { "class": "tag l" });
    const rightTag = make("span", { "class": "tag r" });
    const stack = make("div", { "class": "stack" }, [below, above, cut, leftTag, rightTag]);

    const show = function () {
      const at = Number(slider.value);
      above.style.clipPath = "inset(0 " + (100 - at) + "% 0 0)";
      cut.style.left = at + "%";
      slider.setAttribute("aria-valuetext",
        at + " % " + left.select.value + ", " + (100 - at) + " % " + right.select.value);
    };
    const choose = function () {
      above.src = shots.get(left.select.value).src;
      below.src = shots.get(right.select.value).src;
      above.alt = left.select.value;
      below.alt = right.select.value;
      leftTag.textContent = left.select.value;
      rightTag.textContent = right.select.value;
      show();
    };
    const drag = function (event) {
      if (event.type === "pointerdown") {
        stack.setPointerCapture(event.pointerId);
      } else if (event.buttons === 0) {
        return;
      }
      const frame = stack.getBoundingClientRect();
      const part = 100 * (event.clientX - frame.left) / frame.width;
      slider.value = String(Math.round(Math.min(100, Math.max(0, part))));
      show();
    };
    slider.addEventListener("input", show);
    left.select.addEventListener("change", choose);
    right.select.addEventListener("change", choose);
    stack.addEventListener("pointerdown", drag);
    stack.addEventListener("pointermove", drag);
    const bar = make("div", { "class": "bar" }, [left.label,
      make("label", { "class": "grow" }, ["Cut", slider]), right.label]);
    box.prepend(stack, bar);
    choose();
  }

  /** The pictures of the strip one after the other, with buttons, and a choice of the track. */
  function addPlayer(box) {
    const frames = Array.from(box.querySelectorAll("li"));
    if (frames.length === 0) {
      return;
    }
    const tracks = Array.from(frames[0].querySelectorAll("img")).map(function (image) {
      return image.dataset.track;
    });
    const slider = make("input",
      { type: "range", min: "0", max: String(frames.length - 1), step: "1", value: "0" });
    const back = make("button", { type: "button", "aria-label": "Previous iteration" }, ["\u2190"]);
    const next = make("button", { type: "button", "aria-label": "Next iteration" }, ["\u2192"]);
    const play = make("button", { type: "button", "aria-pressed": "false" }, ["Play"]);
    const track = make("select", {}, tracks.map(function (name) {
      return make("option", { value: name }, [name]);
    }));
    const image = make("img", { alt: "" });
    const caption = make("figcaption", { "aria-live": "polite" });
    let timer = 0;

    const show = function () {
      const frame = frames[Number(slider.value)];
      const chosen = frame.querySelectorAll("img")[Math.max(0, track.selectedIndex)];
      const text = frame.querySelector("figcaption").textContent;
      image.src = chosen.src;
      image.width = chosen.width;
      image.height = chosen.height;
      image.alt = text;
      caption.textContent = text;
      slider.setAttribute("aria-valuetext", text);
    };
    const go = function (to) {
      slider.value = String((to + frames.length) % frames.length);
      show();
    };
    const stop = function () {
      window.clearInterval(timer);
      timer = 0;
      play.textContent = "Play";
      play.setAttribute("aria-pressed", "false");
    };
    slider.addEventListener("input", function () { stop(); show(); });
    track.addEventListener("change", show);
    back.addEventListener("click", function () { stop(); go(Number(slider.value) - 1); });
    next.addEventListener("click", function () { stop(); go(Number(slider.value) + 1); });
    play.addEventListener("click", function () {
      if (timer) {
        stop();
        return;
      }
      timer = window.setInterval(function () { go(Number(slider.value) + 1); }, 400);
      play.textContent = "Stop";
      play.setAttribute("aria-pressed", "true");
    });
    const controls = [play, back, next,
      make("label", { "class": "grow" }, ["Iteration", slider])];
    if (tracks.length > 1) {
      controls.push(make("label", {}, ["Show", track]));
    }
    box.classList.add("scripted");
    box.prepend(make("div", { "class": "bar" }, controls),
      make("figure", { "class": "screen" }, [image, caption]));
    show();
  }

  document.querySelectorAll(".compare").forEach(addComparison);
  document.querySelectorAll(".player").forEach(addPlayer);
}());
