run tests/golden/run/expectations_met.yaml -o tests/golden
