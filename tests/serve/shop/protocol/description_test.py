"""What `lamina serve` says of itself, held against its answers: /openapi.json,
and the schemas of values.

usage: description_test.py LAMINA [unittest's arguments]

The official schema of OpenAPI is where scripts/packages.sh puts it.
"""

import json
import os
import random
import warnings

import jsonschema
import service
from service import by_query

Validator = jsonschema.Draft202012Validator


class DescriptionTest(service.ServiceTest):
    """/openapi.json."""

    def setUp(self):
        super().setUp()
        self.write("broken.scad", "cube(]);\n")
        self.service = self.serve("--metal", "sterling-silver", "--price", "1.10 EUR/g")
        self.description = json.loads(self.service.get("/openapi.json").body)

    def test_is_openapi_3_1(self):
        cache = os.environ.get("LAMINA_TEST_CACHE") or os.path.join(
            os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"),
            "lamina-tests")
        path = os.path.join(cache, "openapi-schemas-2.1.0", "schemas", "v3.1",
                            "schema.json")
        with open(path, encoding="utf-8") as file:
            official = json.load(file)
        Validator(official).validate(self.description)
        for schema in self.description["components"].get("schemas", {}).values():
            Validator.check_schema(schema)

    def validate(self, path, method, answer):
        """That the answer is one that the description has for the address."""
        operation = self.resolved(self.description["paths"][path][method])
        responses = operation["responses"]
        found = responses.get(str(answer.status), responses.get("default"))
        self.assertIsNotNone(found, f"{method} {path}: no {answer.status}")
        content = self.resolved(found).get("content", {})
        kind = answer.headers["Content-Type"]
        if answer.status == 304:
            return
        kinds = {name.split(";")[0]: rest for name, rest in content.items()}
        own = kind.split(";")[0]
        self.assertTrue(own in kinds or "*/*" in kinds, f"{method} {path}: {kind}")
        if own.endswith("json") and "schema" in kinds.get(own, {}):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", DeprecationWarning)
                resolver = jsonschema.RefResolver("", self.description)
                Validator(kinds[own]["schema"], resolver=resolver).validate(
                    json.loads(answer.body))

    def resolved(self, part):
        while "$ref" in part:
            place = self.description
            for name in part["$ref"].removeprefix("#/").split("/"):
                place = place[name.replace("~1", "/").replace("~0", "~")]
            part = place
        return part

    def test_every_route_answers_as_described(self):
        self.assertGreaterEqual(len(self.description["paths"]), 10)
        for path, operations in self.description["paths"].items():
            for method in set(operations) & {"get", "post"}:
                with self.subTest(path, method=method):
                    address = path.replace("{name}", "box")
                    address += "?format=slc" * address.endswith("/layers")
                    answer = (self.service.post if method == "post" else
                              self.service.get)(address)
                    self.assertEqual(answer.status, 200, answer)
                    self.validate(path, method, answer)

    def test_problems_are_as_described(self):
        design, quote = "/designs/{name}/parameters", "/designs/{name}/quote"
        box = "/designs/box/quote"
        cases = [
            (design, "get", 404, self.service.get("/designs/none/parameters")),
            (quote, "post", 404, self.service.post("/designs/none/quote")),
            (quote, "post", 400, self.service.post(box, b"{")),
            (quote, "get", 400, self.service.get(box + "?order=%7B")),
            (quote, "post", 415, self.service.post(box, Content_Type="text/plain")),
            (quote, "post", 413, self.service.post(box, b" " * 70000)),
            (quote, "post", 422, self.service.post(box, {"values": {"length": 99}})),
            (quote, "post", 422, self.service.post(box, {"layer": -1})),
            (quote, "post", 422, self.service.post("/designs/broken/quote")),
            (design, "get", 422, self.service.get("/designs/broken/parameters")),
        ]
        for path, method, status, answer in cases:
            with self.subTest(path, method=method, status=status):
                self.assert_problem(answer, status)
                self.validate(path, method, answer)
        tag = self.service.get(by_query(box, {})).headers["ETag"]
        answer = self.service.get(by_query(box, {}), If_None_Match=tag)
        self.assertEqual(answer.status, 304)
        self.validate(quote, "get", answer)

    def test_a_design_that_fails_says_where(self):
        problem = self.assert_problem(
            self.service.post("/designs/broken/quote"), 422)
        message = problem["messages"][0]
        self.assertEqual((message["line"], message["file"]), (1, "broken.scad"))
        self.assertIn("cube(]);", message["text"])
        self.assertNotIn(self.folder, json.dumps(problem))


class Choices:
    """Values by chance for a schema of /parameters, right ones and wrong ones."""

    WRONG = [None, True, "no", -1e9, 1e300, [], [1], {}, "x" * 2000, 0.123456]

    def __init__(self, schema, seed):
        self.properties = schema["properties"]
        self.random = random.Random(seed)

    def next(self):
        names = self.random.sample(sorted(self.properties),
                                   min(3, len(self.properties)))
        values = {name: self.value(self.properties[name]) for name in names}
        if self.random.random() < 0.1:
            values["nothing_" + names[0]] = 1
        return values

    def value(self, rule):
        if self.random.random() < 0.2:
            return self.random.choice(self.WRONG)
        if "oneOf" in rule:
            return self.random.choice(rule["oneOf"])["const"]
        if rule["type"] == "number":
            return self.number(rule)
        if rule["type"] == "boolean":
            return self.random.random() < 0.5
        if rule["type"] == "array":
            count = rule["minItems"] + self.random.choice([0, 0, 0, 0, 1, -1])
            return [self.number(rule["items"]) for _ in range(max(0, count))]
        return self.random.choice(["", "A", "Ada", "Zoë", "a" * 12,
                                   "x" * (rule.get("maxLength", 30) + 1)])

    def number(self, rule):
        if "minimum" not in rule:
            return self.random.choice([rule.get("default", 1), 50, 7.25])
        low, high = rule["minimum"], rule["maximum"]
        step = rule.get("x-step", (high - low) / 64)
        count = int((high - low) / step + 1e-9)
        return round(low + step * self.random.randint(-1, count + 1), 9)


def is_off_step(rule, value):
    """Whether x-step refuses what the schema's own words cannot."""
    if isinstance(value, list):
        return any(is_off_step(rule.get("items", {}), each) for each in value)
    if (not {"x-step", "minimum"} <= rule.keys() or isinstance(value, bool)
            or not isinstance(value, (int, float)) or value == rule.get("default")):
        return False
    steps = (value - rule["minimum"]) / rule["x-step"]
    return abs(steps - round(steps)) > 1e-6


def is_too_many_bytes(rule, value):
    return (isinstance(value, str) and "x-maxBytes" in rule
            and len(value.encode()) > rule["x-maxBytes"])


class SchemaTest(service.ServiceTest):
    """/designs/{name}/parameters."""

    def test_says_what_the_service_takes(self):
        self.copy_examples()
        running = self.serve("--allow-read", "/usr/share/fonts")
        for design in json.loads(running.get("/designs").body):
            schema = json.loads(running.get(f"/designs/{design}/parameters").body)
            Validator.check_schema(schema)
            self.assertEqual(schema["$schema"],
                             "https://json-schema.org/draft/2020-12/schema")
            own = {name: rule["default"]
                   for name, rule in schema["properties"].items()}
            Validator(schema).validate(own)
            self.compare(running, design, schema, own)
            choices = Choices(schema, design)
            for _ in range(30):
                self.compare(running, design, schema, choices.next())

    def compare(self, running, design, schema, values):
        rules = schema["properties"]
        # Null is as if it were not there, as in the rest of an order.
        given = {name: value for name, value in values.items() if value is not None}
        is_right = Validator(schema).is_valid(given) and not any(
            is_off_step(rules[name], value) or is_too_many_bytes(rules[name], value)
            for name, value in given.items())
        answer = running.post(f"/designs/{design}/quote",
                              {"values": values, "layer": 1})
        with self.subTest(design, values=values):
            self.assertIn(answer.status, (200, 422), answer)
            # A design may fail with what is offered; then it says where.
            is_taken = (answer.status == 200 or
                        bool(json.loads(answer.body).get("messages")))
            self.assertEqual(is_taken, is_right, answer)


if __name__ == "__main__":
    service.main()
