"""Reads records from the tables of `triptych export`, or directly from a store."""

import json
import os
import sqlite3

import pandas as pd


class InputError(Exception):
    """The input cannot be used. The message states what is wrong, where, and what to do."""


# The columns that the analysis uses, in addition to the columns with factors and cost.
RECORD_COLUMNS = ["record", "run", "suite", "plan", "configuration", "technique", "device", "outcome", "injected",
                  "median_wall_ns", "median_device_ns", "device_clock_trusted", "counted_by", "same_as"]
TEXT = {"run", "suite", "plan", "configuration", "technique", "device", "outcome", "injected", "counted_by", "same_as",
        "started_at", "device_key", "processor", "store"}
# Columns that have another name in a store, or are in another table there.
IN_STORE = {"record": "seq", "same_as": "(SELECT configuration FROM same_as WHERE same_as.record = record.seq)"}
FACTOR, COST = "factor_", "cost_"


def read(paths, plan=None):
    """Reads the records from all folders and stores, or only the records of one plan. Returns one row for each record. The
    columns are RECORD_COLUMNS, `store`, `started_at`, `processor`, `device_key`, a `factor_NAME` for each factor and a
    `cost_NAME` for each kind of cost. Missing values are None in text columns and NaN in other columns."""
    if isinstance(paths, (str, os.PathLike)):
        paths = [paths]
    frames = [_read_one(os.fspath(path)) for path in paths]
    records = pd.concat(frames, ignore_index=True)
    plans = sorted(set(records["plan"]))
    if plan is not None:
        records = records[records["plan"] == plan].reset_index(drop=True)
    if records.empty:
        of = f" of {plan}" if plan else ""
        raise InputError(f"no records{of} to analyze in {', '.join(map(str, paths))}; "
                         f"plans: {', '.join(plans) or 'none'}")
    return records


def _read_one(path):
    if os.path.isdir(path):
        return _read_folder(path)
    if os.path.isfile(path):
        return _read_store(path)
    raise InputError(f"{path}: no such file or folder; to create the folder, run `triptych export STORE --out {path}`")


def _read_folder(folder):
    dictionary = _dictionary(folder)
    columns = {each["name"]: each["type"] for each in dictionary["tables"]["records"]["columns"]}
    wanted = [each for each in columns if each in RECORD_COLUMNS or each.startswith((FACTOR, COST))]
    records = _csv(folder, "records", dictionary, wanted)
    runs = _csv(folder, "runs", dictionary, ["run", "store", "started_at", "processor"])
    devices = _csv(folder, "devices", dictionary, ["run", "device", "device_key"])
    return _joined(records, runs, devices)


def _dictionary(folder):
    file = os.path.join(folder, "dictionary.json")
    try:
        with open(file, encoding="utf-8") as text:
            dictionary = json.load(text)
        if dictionary["schema"] != 1:
            raise InputError(f"{file}: schema {dictionary['schema']}, expected 1; export the store again with this version of Triptych")
        return dictionary
    except FileNotFoundError:
        raise InputError(f"{folder}: there is no dictionary.json, which an export writes last; either the export was interrupted, "
                         "or this folder was not written by an export") from None
    except (ValueError, KeyError) as error:
        raise InputError(f"{file}: damaged ({error}); export the store again") from None


def _csv(folder, table, dictionary, columns):
    """Reads columns of a table, with the types that the dictionary states, and checks the number of rows."""
    described = dictionary["tables"][table]
    types = {each["name"]: each["type"] for each in described["columns"]}
    lacking = [each for each in columns if each not in types]
    if lacking:
        raise InputError(f"{folder}: {table}.csv has no column {', '.join(lacking)}; export the store again with this version of Triptych")
    numbers = [each for each in columns if types[each] != "text"]
    file = os.path.join(folder, f"{table}.csv")
    try:
        frame = pd.read_csv(file, usecols=columns, keep_default_na=False, float_precision="round_trip",
                            na_values={each: [""] for each in numbers},
                            dtype={each: "float64" if each in numbers else "category" for each in columns})
    except (OSError, ValueError) as error:
        raise InputError(f"{file}: {error}") from None
    # Removes the apostrophe with which the export protects strings that a spreadsheet would evaluate as formulas.
    for each in set(columns) - set(numbers):
        frame[each] = frame[each].cat.rename_categories(lambda text: text[1:] if text.startswith("'") else text)
    if len(frame) != described["rows"]:
        raise InputError(f"{file}: found {len(frame)} rows, but dictionary.json states {described['rows']}; export the store again")
    return _texts(frame)


def _texts(frame):
    """Converts text columns to objects, with None for missing text."""
    for column in frame.columns:
        if column in TEXT or column.startswith(FACTOR):
            frame[column] = frame[column].astype(object)
            frame.loc[frame[column].isna() | (frame[column] == ""), column] = None
    return frame


def _read_store(file):
    uri = f"file:{os.path.abspath(file).replace('%', '%25').replace('?', '%3f').replace('#', '%23')}?mode=ro"
    try:
        database = sqlite3.connect(uri, uri=True)
        try:
            if database.execute("PRAGMA application_id").fetchone()[0] != 0x54524950:
                raise InputError(f"{file}: not a Triptych store")
            return _from_database(database, file)
        finally:
            database.close()
    except (sqlite3.Error, pd.errors.DatabaseError) as error:
        raise InputError(f"{file}: {error}") from None


def _from_database(database, file):
    own = ", ".join(f"{IN_STORE.get(each, each)} AS {each}" for each in RECORD_COLUMNS)
    records = pd.read_sql(f"SELECT {own} FROM record ORDER BY seq", database)
    for table, prefix in (("factor", FACTOR), ("cost", COST)):
        long = pd.read_sql(f"SELECT record, name, value FROM {table}", database)
        wide = long.pivot(index="record", columns="name", values="value").add_prefix(prefix)
        records = records.join(wide, on="record")
    runs = pd.read_sql("SELECT id AS run, started_at, system FROM run", database)
    runs["processor"] = [json.loads(each).get("processor") for each in runs.pop("system")]
    runs["store"] = file
    devices = pd.read_sql("SELECT run, id AS device, key AS device_key FROM device", database)
    for column in ("median_wall_ns", "median_device_ns"):
        records[column] = records[column].astype("float64")
    return _joined(_texts(records), runs, devices)


def _joined(records, runs, devices):
    joined = records.merge(runs, on="run", how="left").merge(devices, on=["run", "device"], how="left")
    return _texts(joined)
