import { fetchPicture } from "./core_picture.js";
import { element } from "../../../../sdk/web/elements.js";
import { layOver, onMoved } from "./overlay.js";
import { displayName } from "../../../../sdk/web/scene.js";

const DELAY_MS = 120;  // a moving slider does not wait for pictures

/** The terms of a picture that can be shown: names, as in `candela render --terms`, and descriptions. */
function termsOf(scene) {
    const terms = [["", "the picture"], ["ambient", "ambient, I_a"], ["diffuse", "diffuse, the sum of I_d"], ["specular", "specular, the sum of I_s"]];
    scene.lights.forEach(({ label }, i) => terms.push([`light.${i}`, `${displayName(label, "light", i)} alone`], [`n_dot_l.${i}`, `N·L of ${displayName(label, "light", i)}`]));
    return [...terms, ["surroundings", "surroundings"], ["background", "background"], ["normal", "N"], ["face_normal", "the faces' normals"], ["depth", "depth"],
        ["position", "position"], ["barycentric", "barycentric coordinates"], ["uv", "texture coordinates"], ["opacity", "opacity"], ["facing", "front and back"], ["object", "objects"], ["triangle", "triangles"]];
}

/** How two pictures of RGBA bytes differ: the differences' statistics, and a picture of them from black to white. */
export function compare(a, b) {
    const heat = new Uint8ClampedArray(a.length);
    let largest = 0, sum = 0, beyond = 0;
    for (let i = 0; i < a.length; i += 4) {
        const levels = [0, 1, 2].map((c) => Math.abs(a[i + c] - b[i + c])), most = Math.max(...levels);
        largest = Math.max(largest, most);
        sum += levels[0] + levels[1] + levels[2];
        if (most > 2) beyond += 1;
        // Black, red, yellow, white; from 1 level to 64.
        const heatOf = most === 0 ? 0 : 0.15 + 0.85 * Math.min(1, Math.log2(most) / 6);
        heat.set([0, 1, 2].map((c) => 255 * Math.min(1, Math.max(0, 3 * heatOf - c))), i);
        heat[i + 3] = 255;
    }
    const pixels = a.length / 4;
    return { heat, largest, mean: sum / (3 * pixels), beyond, pixels };
}

/**
 * The renderer's own picture of the page's scene, laid over the page's: a part of it (wipe), or the difference. Available only
 * if `candela view` serves the page, since the picture comes from there.
 */
export class Reference {
    /** `pixels`: the page's picture of the scene's size, as rows of RGBA bytes. */
    constructor(settings, canvas, pixels) {
        Object.assign(this, { settings, pictureCanvas: canvas, pixels });
        this.overlay = document.getElementById("reference-canvas");
        this.mode = document.getElementById("reference-mode");
        this.share = document.getElementById("reference-share");
        this.text = document.getElementById("reference-text");
        this.term = document.getElementById("reference-term");
        this.term.replaceChildren(...termsOf(settings.scene).map(([value, text]) => element("option", { value }, text)));
        this.request = 0;
        document.getElementById("reference").hidden = false;
        this.mode.addEventListener("change", () => this.invalidate());
        this.term.addEventListener("change", () => this.invalidate());
        this.share.addEventListener("input", () => this.place());
        onMoved(this.overlay, canvas, () => this.place());
        settings.listeners.push(() => this.invalidate());
    }

    /** Called when something in the picture has changed. */
    invalidate() {
        this.request += 1;
        const isOn = this.mode.value !== "off";
        this.share.parentElement.hidden = this.mode.value !== "wipe";
        this.term.parentElement.hidden = this.mode.value !== "wipe";  // a term differs from the page's picture by design
        this.overlay.hidden = true;
        this.text.textContent = isOn ? "Candela renders …" : "";
        clearTimeout(this.timer);
        if (isOn) this.timer = setTimeout(() => this.update(this.request), DELAY_MS);
    }

    async update(request) {
        let picture = null, problem = "";
        try {
            picture = await fetchPicture(this.settings, this.shownTerm());
        } catch (error) {
            problem = error.message;
        }
        if (request !== this.request) return;
        if (picture === null) this.text.textContent = problem;
        else this.show(picture);
    }

    /** The term in place of the picture; empty for the picture itself. */
    shownTerm() {
        return this.mode.value === "wipe" ? this.term.value : "";
    }

    show(picture) {
        const { width, height } = picture, { overlay } = this;
        Object.assign(overlay, { width, height });
        const context = overlay.getContext("2d", { willReadFrequently: true });
        context.drawImage(picture, 0, 0);
        if (this.shownTerm() === "") this.tellDifference(context, width, height);
        else this.text.textContent = "";
        overlay.hidden = false;
        this.place();
    }

    tellDifference(context, width, height) {
        const own = this.pixels(width, height), reference = context.getImageData(0, 0, width, height).data;
        const { heat, largest, mean, beyond, pixels } = compare(own, reference);
        if (this.mode.value === "difference") context.putImageData(new ImageData(heat, width, height), 0, 0);
        const count = beyond === 1 ? "1 pixel differs" : `${beyond} of ${pixels} pixels differ`;
        this.text.textContent = `${count} by more than 2 levels of 255; at most ${largest}, ${mean.toFixed(4)} on average.`;
    }

    place() {
        layOver(this.overlay, this.pictureCanvas);
        this.overlay.style.clipPath = this.mode.value === "wipe" ? `inset(0 0 0 ${100 - Number(this.share.value)}%)` : "none";
    }
}
