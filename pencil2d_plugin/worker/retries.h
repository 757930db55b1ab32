// How soon to try again what has failed.
#pragma once

#include <QElapsedTimer>
#include <QVector>

#include <optional>

namespace lampblack
{

/// At once, after 1 s, after 3 s; a fourth failure within a minute is the last.
class Retries
{
public:
    /// Milliseconds after which to try again, after one more failure; no value: give up.
    std::optional<int> delayAfterFailure();
    void forget() { mFailures.clear(); }
    int failures() const { return int(mFailures.size()); } ///< within the last minute

private:
    QElapsedTimer mClock;
    QVector<qint64> mFailures; ///< times by mClock, of the last minute
};

} // namespace lampblack
