"""Edit by constraints of your own, and look at what holds and what gave way.

Run in the root of the repository: python examples/edit_by_program.py
"""

from iconjax import edit

program = """
# The cup comes down onto the base; the base stays where it is.
translate("Trophy:Cup")
stay("Trophy:Base")
touch("Trophy:Cup", "Trophy:Base")
"""

result = edit("eval/benchmark/trophy-cup-base", program=program)
for constraint in result.constraints:
    print(f"{constraint.text}: off by {constraint.violation:.2f} {constraint.unit}")
for relation in result.relations:
    print(f"{relation.a} - {relation.b}: {relation.state}")
result.save("edited.png")
result.to_html("trace.html")
