"""The reader of the programs and the JSON schemas, side by side."""
import json
import pathlib
import subprocess

import jsonschema


class Reader:
    """readDictionaries as a running program."""

    def __init__(self, program, folder):
        self.process = subprocess.Popen([program, str(folder)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8")

    def problems(self, file, text):
        self.process.stdin.write(json.dumps({"file": file, "text": text}) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        assert answer, f"the reader ended at {file}:\n{text}"
        return json.loads(answer)

    def close(self):
        self.process.stdin.close()
        return self.process.wait()


class Schemas:
    def __init__(self, folder):
        self.validators = {path.stem: jsonschema.Draft7Validator(json.loads(path.read_text())) for path in pathlib.Path(folder).glob("*.json")}
        for validator in self.validators.values():
            jsonschema.Draft7Validator.check_schema(validator.schema)

    def faults(self, file, data):
        validator = self.validators[pathlib.PurePath(file).stem]
        return [f"{'/'.join(map(str, e.absolute_path))}: {e.message}" for e in validator.iter_errors(data)]
