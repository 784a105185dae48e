// The tests' programs see the environment, as on every machine: how GoogleTest deals out its tests.
Module.preRun = () => Object.assign(ENV, process.env);
