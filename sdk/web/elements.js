let elementCount = 0;
export const newId = (word) => `${word}-${++elementCount}`;

/**
 * `properties`: the element's own, "class", and attributes if the name contains a "-" or is "role" or "for". Children that
 * are null are left out. Texts come from scene files, so they are only ever set as text, never as HTML.
 */
export function element(tag, properties = {}, ...children) {
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

/** An element of a drawing. */
export function svgElement(tag, attributes, ...children) {
    const result = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) result.setAttribute(name, value);
    result.append(...children);
    return result;
}

/** A text of any language, whose writing direction does not affect its surroundings. */
export const isolated = (text) => element("bdi", {}, text);
