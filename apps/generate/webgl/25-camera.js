// Candela's camera: an observer, and how it turns around what it looks at.

function axesOf(observer) {
    const forward = normalized(subtract(observer.look_at, observer.position));
    const right = normalized(cross(forward, observer.up));
    return { forward, right, up: cross(right, forward) };
}

/// What is wrong with an observer; null where nothing is.
function observerComplaint(observer) {
    const view = subtract(observer.look_at, observer.position);
    if (!(lengthOf(view) > 0)) return "the observer must look at another place than its own";
    if (lengthOf(cross(normalized(view), normalized(observer.up))) < 1e-6) return "the observer must not look along up";
    return null;
}

/// Depths between which all corners of the boxes lie, seen from the observer.
function depthRange(observer, forward, boxes) {
    let nearest = Infinity, farthest = -Infinity;
    for (const { low, high } of boxes) {
        for (let corner = 0; corner < 8; ++corner) {
            const place = low.map((x, axis) => ((corner >> axis) & 1 ? high[axis] : x));
            const depth = dot(forward, subtract(place, observer.position));
            nearest = Math.min(nearest, depth);
            farthest = Math.max(farthest, depth);
        }
    }
    if (!(farthest > 0)) return { near: 0.1, far: 1 };
    const far = farthest * 1.001;
    return { near: Math.max(0.9 * nearest, far * 1e-5), far };
}

/// Column by column; `shift` moves the picture by so many pixels to the right and to the bottom.
function viewProjection(observer, boxes, width, height, shift) {
    const { forward, right, up } = axesOf(observer);
    const { near, far } = depthRange(observer, forward, boxes);
    const isOrthographic = observer.projection === "orthographic";
    const scale = isOrthographic ? 2 / observer.height : 1 / Math.tan((observer.fov * Math.PI) / 360);
    const row = (axis, factor) => [...scaled(axis, factor), -factor * dot(axis, observer.position)];
    const depth = row(forward, 1);
    const w = isOrthographic ? [0, 0, 0, 1] : depth;
    const plus = (a, b, factor) => a.map((x, i) => x + factor * b[i]);
    const x = plus(row(right, (scale * height) / width), w, (2 * shift[0]) / width);
    const y = plus(row(up, scale), w, (-2 * shift[1]) / height);
    const [slope, offset] = isOrthographic
        ? [2 / (far - near), -(far + near) / (far - near)]
        : [(far + near) / (far - near), (-2 * far * near) / (far - near)];
    const z = plus(scaled(depth, slope), [0, 0, 0, 1], offset);
    return new Float32Array([0, 1, 2, 3].flatMap((i) => [x[i], y[i], z[i], w[i]]));
}

/// Angles in radians; never over the poles.
function orbited(observer, turn, rise) {
    const pole = normalized(observer.up);
    const offset = subtract(observer.position, observer.look_at);
    const distance = lengthOf(offset);
    const limit = (89 * Math.PI) / 180;
    const elevation = Math.asin(Math.max(-1, Math.min(1, dot(offset, pole) / distance)));
    const aimed = Math.max(-limit, Math.min(limit, elevation + rise));
    const level = normalized(rotated(subtract(offset, scaled(pole, dot(offset, pole))), pole, turn));
    const turned = add(scaled(level, distance * Math.cos(aimed)), scaled(pole, distance * Math.sin(aimed)));
    return { ...observer, position: tidy(add(observer.look_at, turned)) };
}

/// Nearer where `factor` is less than 1.
function zoomed(observer, factor) {
    if (observer.projection === "orthographic") return { ...observer, height: tidy(observer.height * factor) };
    const offset = subtract(observer.position, observer.look_at);
    return { ...observer, position: tidy(add(observer.look_at, scaled(offset, factor))) };
}
