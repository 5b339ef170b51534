"""Which of these files does the published schema accept? SCHEMA FILE... ; prints one line a file: 'yes' or 'no'."""
import json
import sys

import jsonschema

with open(sys.argv[1], encoding="utf-8") as stream:
    schema = json.load(stream)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
for name in sys.argv[2:]:
    with open(name, encoding="utf-8") as stream:
        print("yes" if validator.is_valid(json.load(stream)) else "no")
