// Numbers for gestures: edits of a scene with the same number are undone as one step.
#pragma once

#include <QElapsedTimer>
#include <QString>

namespace lampblack
{

/// A new number; never 0.
int newGesture();

/// Joins small steps that follow each other (wheel notches, nudges, spins) into one gesture.
class GestureSequence
{
public:
    /// The same number as before if `subject` is the same and less than a second has passed, otherwise a new
    /// one.
    int gestureFor(const QString& subject);
    void end() { mSubject.clear(); }

private:
    QElapsedTimer mElapsed;
    QString mSubject;
    int mGesture = 0;
};

} // namespace lampblack
