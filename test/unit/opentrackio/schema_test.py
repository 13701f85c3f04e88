# Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
"""Validates the output of print_samples with JSON schemas: ours for the requirements of a sender, and the standard's if its
folder is given. Usage: schema_test.py PRINT_SAMPLES REQUIRED_JSON [FOLDER]"""

import json
import os
import subprocess
import sys

import jsonschema


def main():
    program, required = sys.argv[1:3]
    schemas = [required]
    if len(sys.argv) > 3:
        schemas.append(os.path.join(sys.argv[3], "schema.json"))
    printed = subprocess.run([program], check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout
    samples = [json.loads(line) for line in printed.splitlines()]
    # 256 cases, 2 encodings, with and without the static part.
    assert len(samples) == 1024, len(samples)
    for path in schemas:
        with open(path, encoding="utf-8") as file:
            schema = json.load(file)
        validator_class = jsonschema.validators.validator_for(schema)
        validator_class.check_schema(schema)
        validator = validator_class(schema)
        for number, sample in enumerate(samples):
            errors = [f"{'.'.join(map(str, e.absolute_path))}: {e.message}" for e in validator.iter_errors(sample)]
            assert not errors, f"sample {number} by {path}: {errors}"
        # Otherwise the schema might accept everything.
        broken = dict(samples[0], transforms=[])
        assert list(validator.iter_errors(broken)), f"{path} accepts a sample without transforms"
        print(f"{len(samples)} samples by {os.path.basename(path)}")


if __name__ == "__main__":
    main()
