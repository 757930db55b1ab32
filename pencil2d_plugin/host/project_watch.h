// Which project is open, and when it is opened and saved.
#pragma once

#include "host/parts.h"

#include <QDateTime>
#include <QTimer>

namespace lampblack
{

/// The project's path in a window title ("[*]/shots/walk.pclx"); empty if it names none.
QString projectOf(const QString& title);

class ProjectWatch : public QObject
{
    Q_OBJECT

public:
    ProjectWatch(const Parts& parts, QObject* parent);
    ~ProjectWatch() override;

    QString path() const { return mPath; }
    bool isModified() const { return mParts.window != nullptr && mParts.window->isWindowModified(); }
    bool open(const QString& path);
    bool save();

    bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
    void opened(const QString& path);
    void saved(const QString& path);

private Q_SLOTS:
    void onLoaded();

private:
    void settle();
    void tellOfSave();

    Parts mParts;
    QTimer mSettle;
    QString mPath;
    QDateTime mWritten; ///< when the file was last written, as far as we know
    bool mLoaded = false;
};

} // namespace lampblack
