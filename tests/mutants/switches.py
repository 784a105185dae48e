"""Many mutants (operators.py) in one source: each statement that some of them change asks which of
them is on. What cannot be written so (a declaration over several names, a type that differs) is
left out."""
import re

ON = "::foretouch_mutants::on(%d)"
CONDITION = re.compile(r"^(\s*(?:\} else )?(?:if|while) \()(?!constexpr)")
FOR = re.compile(r"^(\s*for \()([^;]*);([^;]*);(.*)$", re.S)
RETURN = re.compile(r"^\s*return\b")
DECLARATION = re.compile(r"^(\s*(?:inline |static )*(?:const|constexpr)? ?[\w:]+(?:<[^=;]*>)?(?: const)?[ &*]+\w+ = )(.*);\s*$", re.S)
STATEMENT = re.compile(r"^\s*(?:[\w*(+]|--)")
KEYWORDS = re.compile(r"^\s*(?:case|default|else|do|break|continue|using|namespace|class|struct|enum|template|public|private|"
                      r"static_assert|friend|typedef|switch|goto|extern|virtual|explicit|\[\[)\b")


def closing(text, start):
    """Where the parenthesis that opens before `start` closes."""
    depth = 1
    for i in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        if depth == 0:
            return i
    return -1


def has_comma(text):
    """Outside of brackets: there are several names."""
    depth = 0
    for c in text:
        depth += {"(": 1, "[": 1, "{": 1, "<": 1, ")": -1, "]": -1, "}": -1, ">": -1}.get(c, 0)
        if c == "," and depth <= 0:
            return True
    return False


def balance(line):
    return sum({"(": 1, "[": 1, ")": -1, "]": -1}.get(c, 0) for c in line)


def statements(lines, code_of):
    """Ranges [first, end) of lines that are one statement, or the head of one."""
    first = 0
    while first < len(lines):
        end, open_, text = first, 0, ""
        while end < len(lines) and end - first < 12:
            code = code_of(lines[end]).rstrip()
            open_ += balance(code)
            end += 1
            text = code
            if open_ <= 0 and (not code.strip() or code.endswith((";", "{", "}", ":")) or code.strip().startswith("#")):
                break
        yield first, end
        first = end


def switched(text, changed):
    """The statement `text`, asked for each of `changed`: number and how it reads; None: it cannot be."""
    def chain(texts, original):
        return "".join(f"{ON % k} ? ({mutant}) : " for k, mutant in texts) + f"({original})"

    if KEYWORDS.match(text):
        return None
    found = CONDITION.match(text)
    if found:
        end = closing(text, found.end())
        if end < 0:
            return None
        heads, bodies = [], []
        for k, mutant in changed:
            cut = end + len(mutant) - len(text)
            if mutant[:found.end()] == text[:found.end()] and mutant[cut:] == text[end:]:
                heads.append((k, mutant[found.end():cut]))
            else:
                bodies.append((k, mutant))
        if heads:
            condition = chain(heads, text[found.end():end])
            text = text[:found.end()] + condition + text[end:]
        return text if heads and not bodies else None
    found = FOR.match(text)
    if found:
        conditions = []
        for k, mutant in changed:
            other = FOR.match(mutant)
            if not other or (other[1], other[2], other[4]) != (found[1], found[2], found[4]):
                return None
            conditions.append((k, other[3]))
        return f"{found[1]}{found[2]}; {chain(conditions, found[3])};{found[4]}"
    if not text.rstrip().endswith(";"):
        return None
    if RETURN.match(text):
        return "{ " + " ".join(f"if ({ON % k}) {{ {mutant.strip()} }}" for k, mutant in changed) + f" {text.strip()} }}"
    found = DECLARATION.match(text)
    if found:
        if has_comma(found[2]):
            return None
        values = []
        for k, mutant in changed:
            other = DECLARATION.match(mutant)
            if not other or other[1] != found[1]:
                return None
            values.append((k, other[2]))
        return found[1].replace("constexpr ", "const ") + chain(values, found[2]) + ";"
    if re.match(r"^\s*(?:const |constexpr |static |inline |auto )", text) or not STATEMENT.match(text):
        return None
    return "{ " + " ".join(f"if ({ON % k}) {{ {mutant.strip()} }} else" for k, mutant in changed) + f" {{ {text.strip()} }} }}"


def with_switches(source, mutants, code_of):
    """The source with the mutants, a number each, in it; and the numbers of those that are."""
    lines = source.split("\n")
    of_line = {}
    for k, mutant in mutants.items():
        of_line.setdefault(mutant.line - 1, []).append(k)
    inside = set()
    for first, end in statements(list(lines), code_of):
        numbers = [k for line in range(first, end) for k in of_line.get(line, [])]
        if not numbers:
            continue
        original = "\n".join(source.split("\n")[first:end])
        changed = []
        for k in numbers:
            mutant = mutants[k]
            whole = source.split("\n")
            line = whole[mutant.line - 1]
            whole[mutant.line - 1] = line[:mutant.column] + mutant.after + line[mutant.column + len(mutant.before):]
            changed.append((k, "\n".join(whole[first:end])))
        if any("//" in lines[i] for i in range(first, end - 1)):
            continue  # a comment would swallow what follows
        text = on_one_line(original)
        changed = [(k, on_one_line(mutant)) for k, mutant in changed]
        result = switched(text, changed)
        if result is None:
            continue
        inside.update(numbers)
        # As many lines as before: what a compiler says of a line is about its mutants.
        flat = " ".join(part.strip() for part in result.split("\n"))
        lines[first:end] = [flat] + [""] * (end - first - 1)
    return "\n".join(lines), inside


def on_one_line(text):
    first, *others = [code_line(line) for line in text.split("\n")]
    return " ".join([first, *(line.strip() for line in others)])


def code_line(line):
    """Without a comment at its end."""
    cut = line.find("//")
    return line[:cut].rstrip() if cut >= 0 and '"' not in line[:cut] else line
