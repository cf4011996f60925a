"""Offers held against python3-jsonschema: values are accepted exactly if the
schema of the offer does, with the rules that it has beyond JSON Schema.

usage: schema_test.py OFFER_CASES [SEEDS [FIRST_SEED]]
"""

import json
import subprocess
import sys
from fractions import Fraction

from jsonschema import Draft202012Validator, ValidationError
from jsonschema.validators import extend


def of_decimals(number):
    return Fraction(repr(number))


def check_step(validator, step, value, schema):
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or "minimum" not in schema or value == schema["default"]:
        return
    step = of_decimals(step)
    steps = (of_decimals(value) - of_decimals(schema["minimum"])) / step
    if abs(steps - round(steps)) > Fraction(1, 1000000):
        yield ValidationError(f"{value} is between two steps")


def check_bytes(validator, most, value, schema):
    if isinstance(value, str) and len(value.encode()) > most:
        yield ValidationError(f"{value} is too long")


OWN_RULES = {"x-step": check_step, "x-maxBytes": check_bytes}
Validator = extend(Draft202012Validator, OWN_RULES)


def validator_of(schema):
    Validator.check_schema(schema)
    validator = Validator(schema)
    own = {name: rule["default"] for name, rule in schema["properties"].items()}
    assert validator.is_valid(own), schema
    return validator


def check_standard_words(schema, errors):
    """Where JSON Schema's words can say a rule, they do."""
    of_standard = {tuple(error.path)[:1] for error in errors
                   if error.validator not in OWN_RULES}
    for error in errors:
        if tuple(error.path)[:1] not in of_standard:
            rule = schema["properties"][error.path[0]]
            assert "multipleOf" not in rule and "anyOf" not in rule, error


def main():
    seeds = sys.argv[2] if len(sys.argv) > 2 else "200"
    first = sys.argv[3] if len(sys.argv) > 3 else "1"
    lines = subprocess.run([sys.argv[1], first, seeds], check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    accepted = by_own_rules = 0
    seed = None
    for line in lines:
        case = json.loads(line)
        if case["seed"] != seed:  # else the offer is that of the line before
            seed = case["seed"]
            validator = validator_of(case["schema"])
        errors = list(validator.iter_errors(case["values"]))
        assert (not errors) == case["accepted"], (line, errors)
        check_standard_words(case["schema"], errors)
        accepted += case["accepted"]
        by_own_rules += bool(errors) and all(
            error.validator in OWN_RULES for error in errors)
    print(f"{len(lines)} values: {accepted} are accepted, {by_own_rules} are "
          "refused by rules beyond JSON Schema alone")
    # Else the values would not be worth a test.
    assert len(lines) / 5 < accepted < len(lines) * 4 / 5
    assert by_own_rules > 0


if __name__ == "__main__":
    main()
