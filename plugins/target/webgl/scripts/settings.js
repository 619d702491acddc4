import { validateObserver } from "../../../../sdk/web/camera.js";
import { areLightsShown } from "./light_places.js";
import { COLOR, COMMON, EXPOSURE, EXPOSURE_PATH, LAYOUT, NORMAL_SCALES, OBSERVER_PARAMETERS, SHADOWS, SHADOWS_PATH, SHOWN, SWITCH, TONE, TONE_PATH, makeParameter } from "./parameters.js";
import { validateValue } from "./validation.js";
import { areEqual, canonicalValue } from "../../../../sdk/web/values.js";

/** Paths come from links, which anybody can write: names that every object inherits must not be found. */
const ownMember = (object, name) => (object && Object.hasOwn(object, name) ? object[name] : undefined);
const PANE = /^pane\.[123]\.((?:shading|reflection)$|(?:object|light)\..*$)/;
/** Pairs of a path and a value, those of panes last: whether a pane's value is its own depends on the first pane's. */
export const panesLast = (changes) => [...changes].sort(([a], [b]) => Number(PANE.test(a)) - Number(PANE.test(b)));
const itemAt = (list, index) => (/^\d+$/.test(index) ? ownMember(list, index) : undefined);

/** Whether pictures or vertices give a parameter, so that no single value does. */
const isTextured = (object, reflection, name) => reflection === object.reflection && object.textured.includes(name);

/**
 * Everything that a user can change, each under a path such as "object.0.material.phong.kd". Only differences from the scene
 * are stored.
 */
export class Settings {
    constructor(scene) {
        this.scene = scene;
        this.changes = new Map();
        this.cache = new Map();
        this.listeners = [];
        this.saved = new Map();
    }

    /** Tells that the next scene contains these changes. */
    expectSaved(changes) {
        this.saved = changes;
    }

    /** Settings for another state of the scene, with those changes that still apply and whose values that state left alone. */
    continuedIn(scene) {
        const result = new Settings(scene);
        for (const [path, value] of panesLast(this.changes)) {
            if (this.saved.has(path) && areEqual(this.saved.get(path), value)) continue;
            const before = this.find(path), now = result.find(path);
            const isSame = now !== null && (PANE.test(path) || areEqual(canonicalValue(now.parameter, before.initial), now.initial));
            if (isSame && validateValue(now.parameter, value) === null) result.set(path, value);
        }
        if (validateObserver(result.observer()) !== null) {
            for (const { name } of result.observerParameters()) result.changes.delete(`observer.${name}`);
        }
        return result;
    }

    /** Like continuedIn(), in place. Listeners are not notified. */
    replaceScene(scene) {
        const { changes } = this.continuedIn(scene);
        Object.assign(this, { scene, changes, cache: new Map(), saved: new Map() });
    }

    observerParameters() {
        const unused = this.scene.observer.projection === "orthographic" ? "fov" : "height";
        return OBSERVER_PARAMETERS.filter(({ name }) => name !== unused);
    }

    /** The parameter at a path and the scene's own value for it: { parameter, initial }; null if there is none. */
    find(path) {
        // Settings that a pane does not override follow the first one.
        const ofPane = PANE.exec(path);
        if (ofPane !== null) {
            const found = this.find(ofPane[1]);
            return found && { parameter: found.parameter, initial: this.get(ofPane[1]) };
        }
        if (!this.cache.has(path)) this.cache.set(path, this.lookUp(path));
        return this.cache.get(path);
    }

    lookUp(path) {
        const { scene } = this;
        const [kind, ...rest] = path.split(".");
        const modelSetting = (models, model, values, name) => {
            const parameter = ownMember(models, model)?.parameters.find((p) => p.name === name);
            return parameter && { parameter, initial: ownMember(values, name) ?? parameter.default };
        };
        let found;
        if (path === "shading" || path === "reflection") {
            const choices = ["", ...Object.keys(scene[`${kind}_models`])];
            found = { parameter: makeParameter(kind, "choice", { choices }), initial: "" };
        } else if (path === SHADOWS_PATH) {
            found = scene.shadows && { parameter: SHADOWS, initial: true };
        } else if (path === EXPOSURE_PATH) {
            found = { parameter: EXPOSURE, initial: scene.image.exposure };
        } else if (path === TONE_PATH) {
            found = { parameter: TONE, initial: scene.image.tone };
        } else if (path === "panes") {
            found = { parameter: LAYOUT, initial: "one" };
        } else if (kind === "show" && rest.length === 1) {
            const parameter = SHOWN.find((p) => p.name === rest[0]);
            found = parameter && { parameter, initial: parameter.name === "lights" && areLightsShown(scene) };
        } else if (kind === "observer" && rest.length === 1) {
            const parameter = this.observerParameters().find((p) => p.name === rest[0]);
            found = parameter && { parameter, initial: scene.observer[rest[0]] };
        } else if (kind === "light") {
            const light = itemAt(scene.lights, rest[0]);
            if (light && rest.length === 2 && rest[1] === "on") found = { parameter: SWITCH, initial: true };
            if (light && rest.length === 3 && rest[1] === "value")
                found = modelSetting(scene.light_models, light.model, light.values, rest[2]);
        } else if (kind === "object") {
            const object = itemAt(scene.objects, rest[0]);
            if (object && rest.length === 2 && rest[1] === "color" && !object.is_color_textured) found = { parameter: COLOR, initial: object.color };
            if (object && rest.length === 3 && rest[1] === "common") found = this.commonSetting(object, rest[2]);
            if (object?.normal_scale?.path === rest.slice(1).join(".") && object.normal_scale.value !== 0)
                found = { parameter: NORMAL_SCALES.get(object.normal_scale.path), initial: object.normal_scale.value };
            if (object && rest.length === 4 && rest[1] === "material" && !isTextured(object, rest[2], rest[3]))
                found = modelSetting(scene.reflection_models, rest[2], ownMember(object.materials, rest[2]), rest[3]);
            if (object && rest.length === 4 && rest[1] === "shading")
                found = modelSetting(scene.shading_models, rest[2], ownMember(object.shadings, rest[2]), rest[3]);
        }
        if (!found || found.initial === null || found.initial === undefined) return null;
        return { parameter: found.parameter, initial: canonicalValue(found.parameter, found.initial) };
    }

    /** A key of every material, where it is a number that shows and no model has a parameter of its name. */
    commonSetting(object, name) {
        const parameter = COMMON.find((p) => p.name === name);
        const isOfModel = Object.values(this.scene.reflection_models).some(({ parameters }) => parameters.some((p) => p.name === name));
        if (!parameter || isOfModel) return undefined;
        // Opaque objects are drawn from one side.
        const isShown = name !== "opacity" || (object.opacity < 1 && object.opacity_cutoff <= 0 && object.opacity_map === null);
        return isShown && { parameter, initial: object[name] };
    }

    get(path) {
        return this.changes.has(path) ? this.changes.get(path) : this.find(path).initial;
    }

    /** These settings as a pane shows them: 0 is the first one, the others may have values of their own. */
    inPane(index) {
        if (index === 0) return this;
        const own = Object.create(this), prefix = `pane.${index}.`;
        own.get = (path) => (this.changes.has(prefix + path) ? this.changes.get(prefix + path) : this.get(path));
        return own;
    }

    /** These settings with another observer, which `observer` returns. */
    seenBy(observer) {
        return Object.assign(Object.create(this), { observer });
    }

    isChanged() {
        return this.changes.size > 0;
    }

    /** The error of a value for a path; null if it is valid. */
    validate(path, value) {
        const found = this.find(path);
        if (found === null) return "is not a part of this scene";
        const error = validateValue(found.parameter, value);
        if (error !== null || !path.startsWith("observer.")) return error;
        return validateObserver({ ...this.observer(), [path.slice("observer.".length)]: value });
    }

    /** Sets a valid value; call notify() afterwards. */
    set(path, value) {
        const { parameter, initial } = this.find(path);
        const canonical = canonicalValue(parameter, value);
        areEqual(canonical, initial) ? this.changes.delete(path) : this.changes.set(path, canonical);
    }

    /**
     * Tells listeners that a path, or all paths that begin with it, have changed; null stands for any. `isFromControl`: the
     * path's own control made the change and shows it already.
     */
    notify(path, isFromControl = false) {
        // Some of them come and go with the display.
        for (const listener of [...this.listeners]) {
            if (this.listeners.includes(listener)) listener(path, isFromControl);
        }
    }

    /** Sets a value that was entered in a control, if it is valid. Returns its error, or null. */
    change(path, value) {
        const error = this.validate(path, value);
        if (error === null) {
            this.set(path, value);
            this.notify(path, true);
        }
        return error;
    }

    reset(isWanted = () => true) {
        for (const path of [...this.changes.keys()]) {
            if (isWanted(path)) this.changes.delete(path);
        }
        this.notify(null);
    }

    observer() {
        const { up, projection, widening } = this.scene.observer;
        const values = this.observerParameters().map(({ name }) => [name, this.get(`observer.${name}`)]);
        return { up, projection, widening, ...Object.fromEntries(values) };
    }

    /** For a valid observer, the result of orbiting or zooming. */
    moveObserver(observer) {
        for (const { name } of this.observerParameters()) this.set(`observer.${name}`, observer[name]);
        this.notify("observer");
    }

    resetView() {
        this.reset((path) => path.startsWith("observer."));
    }

    /** The model in use for an object: the one chosen for all objects, or the object's own. */
    modelOf(object, kind) {
        return this.get(kind) || object[kind];
    }
}
