/** The text of an answer file for `candela exercise grade`. */
export function answerText({ model, function: name }, body) {
    return `${JSON.stringify({ candela_exercise: 1, model, function: name, answer: body.split("\n") }, null, 2)}\n`;
}

/** The body in an answer file. Throws if the file is not an answer, or is about another exercise. */
export function bodyOf(exercise, text) {
    let answer;
    try {
        answer = JSON.parse(text);
    } catch {
        answer = null;
    }
    if (answer?.candela_exercise !== 1 || !Array.isArray(answer.answer)) throw new Error("This file is not an answer to an exercise.");
    if (answer.model !== exercise.model || answer.function !== exercise.function) throw new Error(`This answer belongs to another exercise: ${answer.function} of ${answer.model}.`);
    return answer.answer.join("\n");
}
