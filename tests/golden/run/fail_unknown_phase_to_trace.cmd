run %d/expectations_met.yaml --trace steps
