// Numbers for gestures: edits of a scene that share one undo as one step.
#pragma once

#include <QElapsedTimer>
#include <QString>

namespace lampblack
{

/// A number that no gesture before had; never 0.
int newGesture();

/// Joins small steps that follow each other (notches of a wheel, nudges, spins) into one gesture.
class GestureRun
{
public:
    /// The last number again if `subject` is the same and less than a second has passed, else a new one.
    int of(const QString& subject);
    void end() { mSubject.clear(); }

private:
    QElapsedTimer mSince;
    QString mSubject;
    int mGesture = 0;
};

} // namespace lampblack
