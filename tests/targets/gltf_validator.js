// gltf_validator.js VALIDATOR FILE...: prints the report of Khronos' glTF-Validator on files; exit code 1 for an error or a
// warning.
"use strict";
const fs = require("fs");
const [folder, ...files] = process.argv.slice(2);
const validator = require(require("path").resolve(folder));

async function main() {
    let isSound = true;
    for (const file of files) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: file });
        const { numErrors, numWarnings, messages } = report.issues;
        console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
        for (const message of messages) console.log(`    ${message.severity} ${message.code} ${message.pointer}: ${message.message}`);
        isSound = isSound && numErrors === 0 && numWarnings === 0;
    }
    return isSound ? 0 : 1;
}

main().then((code) => process.exit(code), (problem) => {
    console.error(problem);
    process.exit(1);
});
