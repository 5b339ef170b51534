"""Which of these files does a schema accept? SCHEMA FILE... ; one line a file: 'yes', 'no' or 'no JSON'."""
import json
import sys

import jsonschema

with open(sys.argv[1], encoding="utf-8") as stream:
    schema = json.load(stream)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
for name in sys.argv[2:]:
    with open(name, encoding="utf-8") as stream:
        text = stream.read()
    try:
        value = json.loads(text)
    except (json.JSONDecodeError, RecursionError):
        print("no JSON")
    else:
        print("yes" if validator.is_valid(value) else "no")
