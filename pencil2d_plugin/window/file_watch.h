// Tells when the drawing program has saved.
#pragma once

#include <QDateTime>
#include <QFileSystemWatcher>
#include <QTimer>

namespace lampblack
{

/// Watches a file, also when another one is put in its place, or a folder with the files in it.
class FileWatch : public QObject
{
    Q_OBJECT

public:
    explicit FileWatch(QObject* parent = nullptr);

    /// A file, a folder, or a pattern of names in a folder. Replaces what was watched before.
    void watch(const QString& path);

Q_SIGNALS:
    void changed(); ///< some time after the last of many changes

private:
    /// What tells two states of a file apart.
    struct State
    {
        qint64 bytes = -1; ///< -1 if it is not there
        QDateTime modified;

        bool operator==(const State& other) const
        {
            return bytes == other.bytes && modified == other.modified;
        }
    };

    void follow();
    void onSettled();
    State state() const;

    QString mPath;
    bool mIsFile = false;
    State mState;
    QFileSystemWatcher mWatcher;
    QTimer mSettle;
};

} // namespace lampblack
