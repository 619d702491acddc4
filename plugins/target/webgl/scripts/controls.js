import { fromHex, toHex } from "../../../../sdk/web/colors.js";
import { element, isolated, newId } from "../../../../sdk/web/elements.js";
import { sliderRange } from "./sliders.js";
import { isNumber, roundToFloat } from "../../../../sdk/web/values.js";

const AXES = ["x", "y", "z"];
const CHANNELS = ["red", "green", "blue"];

/** Makes a control for a setting: an element of class "setting" whose method `refresh` shows the setting's value. */
export class Controls {
    /** `extent`: the box that points move in, { low, high } by axis. */
    constructor(settings, extent) {
        this.settings = settings;
        this.extent = extent;
    }

    /** Inputs with a caption, an explanation and a place for errors. */
    row(path, title, inputs, { refresh, isGroup = false }) {
        const { parameter } = this.settings.find(path);
        const message = element("p", { class: "wrong", id: newId("wrong"), role: "alert" });
        const meaning = element("p", { class: "meaning", id: newId("meaning") }, parameter.meaning);
        const caption = element(isGroup ? "div" : "label", { class: "name", id: newId("name") }, isolated(title));
        if (parameter.unit !== "") caption.append(element("span", { class: "unit" }, parameter.unit));
        const result = element(
            "div",
            {
                class: `setting ${parameter.type}`, "data-path": path,
                role: isGroup ? "group" : null, "aria-labelledby": isGroup ? caption.id : null,
            },
            caption, ...inputs, parameter.meaning === "" ? null : meaning, message,
        );
        const fields = [...result.querySelectorAll("input, select")];
        if (!isGroup) {
            fields[0].id ||= newId("input");
            caption.htmlFor = fields[0].id;
        }
        for (const input of fields) {
            if (parameter.meaning !== "") input.setAttribute("aria-describedby", `${meaning.id} ${message.id}`);
            else input.setAttribute("aria-describedby", message.id);
        }
        result.refresh = () => {
            message.textContent = "";
            for (const input of fields) input.removeAttribute("aria-invalid");
            refresh(this.settings.get(path));
            result.classList.toggle("changed", this.settings.changes.has(path));
        };
        result.take = (value, input) => {
            const error = this.settings.change(path, value);
            message.textContent = error === null ? "" : `${title} ${error}.`;
            error === null ? input.removeAttribute("aria-invalid") : input.setAttribute("aria-invalid", "true");
            result.classList.toggle("changed", this.settings.changes.has(path));
        };
        result.refresh();
        return result;
    }

    /** A number field and a slider that show the same number; `take` gets the entered number and its source. */
    numberPair(parameter, { low, high, step }, name, take) {
        const number = element("input", {
            type: "number", step: parameter.type === "integer" ? "1" : "any", inputMode: "decimal", "aria-label": name,
            min: parameter.minimum === null ? "" : roundToFloat(parameter.minimum),
            max: parameter.maximum === null ? "" : roundToFloat(parameter.maximum),
        });
        const slider = element("input", { type: "range", min: low, max: high, step, "aria-label": name && `${name}, slider` });
        const fill = () => slider.style.setProperty("--filled", `${(100 * (slider.value - low)) / (high - low)}%`);
        number.addEventListener("input", () => {
            const value = number.value.trim() === "" ? NaN : Number(number.value);
            if (isNumber(value)) slider.value = value;
            fill();
            take(value, number);
        });
        slider.addEventListener("input", () => {
            number.value = roundToFloat(Number(slider.value));
            number.removeAttribute("aria-invalid");
            fill();
            take(roundToFloat(Number(slider.value)), slider);
        });
        const show = (value) => {
            number.value = slider.value = value;
            fill();
        };
        return { number, slider, show };
    }

    scalar(path, title) {
        const { parameter, initial } = this.settings.find(path);
        const pair = this.numberPair(parameter, sliderRange(parameter, initial), null, (value, input) => row.take(value, input));
        const row = this.row(path, title, [pair.number, pair.slider], { refresh: pair.show });
        pair.slider.setAttribute("aria-label", `${title}, slider`);
        return row;
    }

    /** A line for each of three numbers. */
    vector(path, title, names) {
        const { parameter, initial } = this.settings.find(path);
        const pairs = names.map((name, axis) =>
            this.numberPair(parameter, sliderRange(parameter, initial, axis, this.extent), `${title} ${name}`, (value, input) =>
                row.take(this.settings.get(path).with(axis, value), input)));
        const lines = pairs.map(({ number, slider }, axis) =>
            element(
                "div", { class: `line ${names[axis]}` },
                element("span", { class: "axis", "aria-hidden": "true" }, names[axis][0]), number, slider,
            ));
        const row = this.row(path, title, lines, {
            isGroup: true,
            refresh: (value) => pairs.forEach((pair, axis) => pair.show(value[axis])),
        });
        return row;
    }

    /** One number for all channels, until the user asks for three or they differ. */
    rgb(path, title) {
        const { parameter, initial } = this.settings.find(path);
        const isGray = ([r, g, b]) => r === g && g === b;
        const holder = element("div");
        const split = element("button", { type: "button", class: "split", "aria-label": `rgb: ${title}, one number for each channel` }, "rgb");
        const build = (isSingle) => {
            const pair = (name, take) => this.numberPair(parameter, sliderRange(parameter, initial), name, take);
            let row;
            if (isSingle) {
                const one = pair(null, (value, input) => row.take([value, value, value], input));
                row = this.row(path, title, [one.number, one.slider], { refresh: ([value]) => one.show(value) });
                one.slider.setAttribute("aria-label", `${title}, slider`);
            } else {
                row = this.vector(path, title, CHANNELS);
            }
            const refresh = row.refresh;
            row.refresh = () => (isSingle && !isGray(this.settings.get(path)) ? build(false) : refresh());
            split.setAttribute("aria-pressed", String(!isSingle));
            row.querySelector(".name").after(split);
            holder.replaceChildren(row);
        };
        split.addEventListener("click", () => {
            const isSingle = split.getAttribute("aria-pressed") === "true";
            const [first] = this.settings.get(path);
            if (isSingle && !isGray(this.settings.get(path))) this.settings.change(path, [first, first, first]);
            build(isSingle);
            split.focus();
        });
        build(isGray(this.settings.get(path)));
        return holder;
    }

    color(path, title) {
        const input = element("input", { type: "color" });
        const numbers = element("output", { class: "numbers" });
        input.addEventListener("input", () => {
            row.take(fromHex(input.value), input);
            numbers.textContent = fromHex(input.value).join(" ");
        });
        const row = this.row(path, title, [input, numbers], {
            refresh: (value) => {
                input.value = toHex(value);
                numbers.textContent = value.join(" ");
            },
        });
        numbers.htmlFor = input.id;
        return row;
    }

    choice(path, title, textOf = (choice) => choice) {
        const { parameter } = this.settings.find(path);
        const select = element("select", {}, ...parameter.choices.map((choice) => element("option", { value: choice }, textOf(choice))));
        select.addEventListener("change", () => row.take(select.value, select));
        const row = this.row(path, title, [select], { refresh: (value) => (select.value = value) });
        return row;
    }

    boolean(path, title) {
        const input = element("input", { type: "checkbox" });
        input.addEventListener("change", () => row.take(input.checked, input));
        const row = this.row(path, title, [input], { refresh: (value) => (input.checked = value) });
        return row;
    }

    /** The control for a path, according to its parameter's type; null if there is no such setting. */
    of(path, title) {
        const found = this.settings.find(path);
        if (found === null) return null;
        switch (found.parameter.type) {
            case "real":
            case "integer":
                return this.scalar(path, title);
            case "boolean":
                return this.boolean(path, title);
            case "choice":
                return this.choice(path, title);
            case "color":
                return this.color(path, title);
            case "rgb":
                return this.rgb(path, title);
            default:
                return this.vector(path, title, AXES);
        }
    }
}
