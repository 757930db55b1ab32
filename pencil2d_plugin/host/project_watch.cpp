#include "host/project_watch.h"

#include <QApplication>
#include <QEvent>
#include <QFileInfo>

namespace lampblack
{

namespace
{

constexpr int SettleMs = 120; ///< a project is loaded, then named, then drawn

QDateTime writtenAt(const QString& path)
{
    return path.isEmpty() ? QDateTime() : QFileInfo(path).lastModified();
}

} // namespace

QString projectOf(const QString& title)
{
    QString path = title;
    path.remove(QStringLiteral("[*]"));
    const QFileInfo file(path);
    const bool known = file.suffix() == QLatin1String("pclx") || file.suffix() == QLatin1String("pcl");
    return file.isAbsolute() && known ? file.filePath() : QString();
}

ProjectWatch::ProjectWatch(const Parts& parts, QObject* parent)
    : QObject(parent), mParts(parts), mPath(projectOf(parts.window->windowTitle())),
      mWritten(writtenAt(mPath))
{
    mSettle.setSingleShot(true);
    mSettle.setInterval(SettleMs);
    connect(&mSettle, &QTimer::timeout, this, &ProjectWatch::settle);
    parts.window->installEventFilter(this);
    connect(qApp, &QCoreApplication::aboutToQuit, this, &ProjectWatch::tellOfSave);
    if (has(parts.editor, "objectLoaded()"))
        connect(parts.editor, SIGNAL(objectLoaded()), this, SLOT(onLoaded()));
    for (const char* name : {"actionSave", "actionSave_as"})
    {
        if (QAction* action = parts.action(name))
            connect(action, &QAction::triggered, &mSettle, qOverload<>(&QTimer::start));
    }
}

ProjectWatch::~ProjectWatch()
{
    if (mParts.window != nullptr)
        mParts.window->removeEventFilter(this);
}

bool ProjectWatch::open(const QString& path)
{
    if (!has(qApp, "openFileRequested(QString)") || !QFileInfo(path).isFile())
        return false;
    return QMetaObject::invokeMethod(qApp, "openFileRequested", Qt::QueuedConnection, Q_ARG(QString, path));
}

bool ProjectWatch::save()
{
    QAction* action = mParts.action("actionSave");
    if (action == nullptr || mPath.isEmpty())
        return false;
    action->trigger();
    return writtenAt(mPath) != mWritten;
}

bool ProjectWatch::eventFilter(QObject*, QEvent* event)
{
    if (event->type() == QEvent::WindowTitleChange || event->type() == QEvent::ModifiedChange)
        mSettle.start();
    return false;
}

void ProjectWatch::onLoaded()
{
    mLoaded = true;
    mSettle.start();
}

void ProjectWatch::settle()
{
    if (mParts.window == nullptr)
        return;
    // A project still being read shows its progress in a modal dialog.
    if (QApplication::activeModalWidget() != nullptr)
    {
        mSettle.start();
        return;
    }
    const QString path = projectOf(mParts.window->windowTitle());
    if (!mLoaded)
    {
        if (path != mPath)
            mWritten = QDateTime();
        mPath = path;
        tellOfSave();
        return;
    }
    tellOfSave(); // of the one before, where the artist was asked and said so
    mLoaded = false;
    mPath = path;
    mWritten = writtenAt(path);
    Q_EMIT opened(path);
}

void ProjectWatch::tellOfSave()
{
    const QDateTime written = writtenAt(mPath);
    if (written == mWritten)
        return;
    mWritten = written;
    Q_EMIT saved(mPath);
}

} // namespace lampblack
