#!/usr/bin/env bash
# Every test asserts something: in its body, or through a function of the tests that does.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"

# As clang-format sets them, tests and free functions end with a brace at the margin, members of a class with
# one four columns in. A function of one file of tests is known there alone.
mapfile -t sources < <(find . -name '*.cpp' -o -name '*.hpp' | sort)
awk '
    function asserting(text) { return text ~ /(^|[^A-Za-z_])(EXPECT_[A-Z]|ASSERT_[A-Z]|ADD_FAILURE|FAIL *\()/ }
    function close_body(kind) {
        if (kind == "test") {
            tests[++test_count] = place
            test_file[test_count] = FILENAME
            test_body[test_count] = body
        } else {
            scope = FILENAME ~ /_test\.cpp$/ ? FILENAME : "everywhere"
            functions[scope, name] = functions[scope, name] " " body
        }
        name = body = kind_now = ""
        opened = 0
    }
    FNR == 1 {
        name = body = kind_now = ""
        opened = 0
    }
    /^[ \t]*\/\// { next }
    kind_now == "" && /^(TEST|TEST_F|TEST_P|TYPED_TEST|TYPED_TEST_P)\(/ {
        kind_now = "test"
        place = FILENAME ":" FNR ": " $0
    }
    kind_now == "" && /^(    )?[A-Za-z_].*[A-Za-z_0-9]\(/ && !/^(    )?(namespace|using|return|class|struct|if|for|while|switch|else|case)[^A-Za-z_0-9]/ && !/;$/ {
        kind_now = /^    / ? "member" : "function"
        name = $0
        sub(/\(.*/, "", name)
        sub(/.*[^A-Za-z_0-9]/, "", name)
    }
    kind_now != "" { body = body "\n" $0 }
    kind_now != "" && /^ *[{]|[{]$|[{].*}$/ { opened = 1 }
    kind_now != "" && !opened && /;$/ { name = body = kind_now = "" } # a declaration
    kind_now == "member" && /^    }|[{].*}$/ { close_body("member") }
    kind_now != "member" && kind_now != "" && /^}/ { close_body(kind_now) }
    END {
        for (key in functions)
            if (asserting(functions[key]) && key !~ /report_value$/) # which nothing is held to
                known[key] = 1
        do {
            grown = 0
            for (key in functions) {
                split(key, parts, SUBSEP)
                if (!(key in known) && calls_one(functions[key], parts[1]))
                    grown = known[key] = 1
            }
        } while (grown)
        for (i = 1; i <= test_count; ++i)
            if (!asserting(test_body[i]) && !calls_one(test_body[i], test_file[i])) {
                print tests[i] ": asserts nothing"
                wrong = 1
            }
        if (test_count == 0)
            print "no tests are found"
        exit wrong || test_count == 0
    }
    function calls_one(text, file,    rest, called) {
        rest = text
        while (match(rest, /[A-Za-z_][A-Za-z_0-9]*(<[A-Za-z_0-9:]*>)? *[({]/)) {
            called = substr(rest, RSTART, RLENGTH)
            sub(/[^A-Za-z_0-9].*/, "", called)
            if ((file, called) in known || ("everywhere", called) in known)
                return 1
            rest = substr(rest, RSTART + RLENGTH)
        }
        return 0
    }
' "${sources[@]}"
