// All that a person can change, each under a path such as "object.0.material.phong.kd". What differs from the scene is kept.

const parameterOf = (name, type, rest = {}) => ({
    name, type, unit: "", meaning: "", default: null, choices: [],
    minimum: null, maximum: null, minimum_excluded: false, maximum_excluded: false, ...rest,
});

const OBSERVER_PARAMETERS = [
    parameterOf("position", "point", { unit: "m", meaning: "where the observer is" }),
    parameterOf("look_at", "point", { unit: "m", meaning: "the middle of the picture" }),
    parameterOf("fov", "real", {
        unit: "deg", meaning: "the full vertical angle of view",
        minimum: 0, maximum: 180, minimum_excluded: true, maximum_excluded: true,
    }),
    parameterOf("height", "real", { unit: "m", meaning: "what fits the picture's height", minimum: 0, minimum_excluded: true }),
];
const COLOR = parameterOf("color", "color", { meaning: "the object's own colour" });
const SWITCH = parameterOf("on", "boolean", { meaning: "whether the light is lit" });

/// The own member of that name; never what objects inherit.
const member = (object, name) => (object && Object.hasOwn(object, name) ? object[name] : undefined);
const item = (list, index) => (/^\d+$/.test(index) ? member(list, index) : undefined);

class Settings {
    constructor(scene) {
        this.scene = scene;
        this.changes = new Map();
        this.found = new Map();
        this.listeners = [];
    }

    observerParameters() {
        const unused = this.scene.observer.projection === "orthographic" ? "fov" : "height";
        return OBSERVER_PARAMETERS.filter(({ name }) => name !== unused);
    }

    /// { parameter, own } of a path: what may stand there, and what the scene says; null where there is no such thing.
    find(path) {
        if (!this.found.has(path)) this.found.set(path, this.lookUp(path));
        return this.found.get(path);
    }

    lookUp(path) {
        const { scene } = this;
        const [kind, ...rest] = path.split(".");
        const modelSetting = (models, model, values, name) => {
            const parameter = member(models, model)?.parameters.find((p) => p.name === name);
            return parameter && { parameter, own: member(values, name) ?? parameter.default };
        };
        let found;
        if (path === "shading" || path === "reflection") {
            const choices = ["", ...Object.keys(scene[`${kind}_models`])];
            found = { parameter: parameterOf(kind, "choice", { choices }), own: "" };
        } else if (kind === "observer" && rest.length === 1) {
            const parameter = this.observerParameters().find((p) => p.name === rest[0]);
            found = parameter && { parameter, own: scene.observer[rest[0]] };
        } else if (kind === "light") {
            const light = item(scene.lights, rest[0]);
            if (light && rest.length === 2 && rest[1] === "on") found = { parameter: SWITCH, own: true };
            if (light && rest.length === 3 && rest[1] === "value")
                found = modelSetting(scene.light_models, light.model, light.values, rest[2]);
        } else if (kind === "object") {
            const object = item(scene.objects, rest[0]);
            if (object && rest.length === 2 && rest[1] === "color") found = { parameter: COLOR, own: object.color };
            if (object && rest.length === 4 && rest[1] === "material")
                found = modelSetting(scene.reflection_models, rest[2], member(object.materials, rest[2]), rest[3]);
            if (object && rest.length === 4 && rest[1] === "shading")
                found = modelSetting(scene.shading_models, rest[2], member(object.shadings, rest[2]), rest[3]);
        }
        if (!found || found.own === null || found.own === undefined) return null;
        return { parameter: found.parameter, own: canonical(found.parameter, found.own) };
    }

    get(path) {
        return this.changes.has(path) ? this.changes.get(path) : this.find(path).own;
    }

    isChanged() {
        return this.changes.size > 0;
    }

    /// What is wrong with a value there; null where nothing is.
    complaint(path, value) {
        const found = this.find(path);
        if (found === null) return "is not a part of this scene";
        const problem = complaint(found.parameter, value);
        if (problem !== null || !path.startsWith("observer.")) return problem;
        return observerComplaint({ ...this.observer(), [path.slice(9)]: value });
    }

    /// The value must be all right.
    put(path, value) {
        const { parameter, own } = this.find(path);
        const wanted = canonical(parameter, value);
        areEqual(wanted, own) ? this.changes.delete(path) : this.changes.set(path, wanted);
    }

    /// `path`: the one that has changed, what such paths begin with, or null for many. `byHand`: by its own control.
    tell(path, byHand = false) {
        for (const listener of this.listeners) listener(path, byHand);
    }

    /// Takes a value that a person has put in; what is wrong with it, or null.
    change(path, value) {
        const problem = this.complaint(path, value);
        if (problem === null) {
            this.put(path, value);
            this.tell(path, true);
        }
        return problem;
    }

    reset(isWanted = () => true) {
        for (const path of [...this.changes.keys()]) {
            if (isWanted(path)) this.changes.delete(path);
        }
        this.tell(null);
    }

    observer() {
        const { up, projection } = this.scene.observer;
        const values = this.observerParameters().map(({ name }) => [name, this.get(`observer.${name}`)]);
        return { up, projection, ...Object.fromEntries(values) };
    }

    /// From turning and zooming.
    moveObserver(observer) {
        for (const { name } of this.observerParameters()) this.put(`observer.${name}`, observer[name]);
        this.tell("observer");
    }

    resetView() {
        this.reset((path) => path.startsWith("observer."));
    }

    /// The model in force: the one for all objects, or the object's own.
    modelOf(object, kind) {
        return this.get(kind) || object[kind];
    }
}
