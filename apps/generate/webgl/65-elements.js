// Elements of the page. Texts come from scene files, so they are only ever set as text.

let elementCount = 0;
const newId = (word) => `${word}-${++elementCount}`;

/// `properties`: those of the element, "class", and attributes where they hold a "-" or are "role" or "for".
function element(tag, properties = {}, ...children) {
    const result = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
        if (value === null || value === undefined) continue;
        if (name === "class") result.className = value;
        else if (name.includes("-") || ["role", "for"].includes(name)) result.setAttribute(name, value);
        else result[name] = value;
    }
    result.append(...children.filter((child) => child !== null));
    return result;
}

/// A text of any language: its direction does not reach what stands around it.
const label = (text) => element("bdi", {}, text);

const hexOf = (color) =>
    "#" + color.map((c) => Math.round(Math.min(255, Math.max(0, c))).toString(16).padStart(2, "0")).join("");
const colorOf = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
