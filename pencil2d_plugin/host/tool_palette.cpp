#include "host/tool_palette.h"

#include <QActionGroup>
#include <QGuiApplication>
#include <QLayout>
#include <QMenu>

#include <algorithm>

namespace lampblack
{

ToolPalette::ToolPalette(const Parts& parts, QObject* parent) : QObject(parent), mParts(parts)
{
}

ToolPalette::~ToolPalette()
{
    deactivate();
    delete mButton;
}

void ToolPalette::add(QAction* tool)
{
    const QVector<QToolButton*> tools = mParts.toolButtons();
    if (mAction != nullptr || tools.isEmpty())
        return;
    mAction = tool;
    const QToolButton* neighbour = tools.last();
    auto* layout = neighbour->parentWidget()->layout();
    mButton = new QToolButton(neighbour->parentWidget());
    mButton->setObjectName(QStringLiteral("lampblackButton"));
    mButton->setDefaultAction(tool);
    mButton->setToolButtonStyle(Qt::ToolButtonIconOnly);
    mButton->setIconSize(neighbour->iconSize());
    mButton->setMinimumSize(neighbour->minimumSize());
    mButton->setMaximumSize(neighbour->maximumSize());
    mButton->setSizePolicy(neighbour->sizePolicy());
    mButton->setAutoRaise(neighbour->autoRaise());
    mButton->setFocusPolicy(neighbour->focusPolicy());
    mButton->setStyleSheet(neighbour->styleSheet());
    layout->addWidget(mButton);
    mButton->show();

    connect(tool, &QAction::toggled, this, &ToolPalette::onToggled);
    // In an exclusive group, clicking the active tool again keeps it, as with the other tools.
    (new QActionGroup(this))->addAction(tool);
    connect(mParts.tools, SIGNAL(toolChanged(ToolType)), this, SLOT(onToolChanged()));
    for (QToolButton* other : tools)
        connect(other, &QToolButton::clicked, this, &ToolPalette::deactivate);

    auto* menu = mParts.window->findChild<QMenu*>(QStringLiteral("menuTools"));
    if (menu == nullptr)
    {
        mParts.window->addAction(tool);
        return;
    }
    const QList<QAction*> entries = menu->actions();
    for (QAction* other : entries)
        connect(other, &QAction::triggered, this, &ToolPalette::deactivate);
    const auto separator = std::find_if(entries.begin(), entries.end(),
                                        [](const QAction* entry) { return entry->isSeparator(); });
    menu->insertAction(separator == entries.end() ? nullptr : *separator, tool);
}

void ToolPalette::onToggled(bool checked)
{
    if (checked)
        uncheckOthers();
    else if (mBefore != nullptr)
    {
        const QVector<QToolButton*> tools = mParts.toolButtons();
        const bool other = std::any_of(tools.begin(), tools.end(),
                                       [this](const QToolButton* button)
                                       { return button != mButton && button->isChecked(); });
        if (!other)
            mBefore->setChecked(true);
        mBefore = nullptr;
    }
    Q_EMIT activated(checked);
}

void ToolPalette::uncheckOthers()
{
    const QVector<QToolButton*> tools = mParts.toolButtons();
    for (QToolButton* button : tools)
    {
        if (button == mButton || !button->isChecked())
            continue;
        mBefore = button;
        button->setChecked(false);
    }
}

void ToolPalette::onToolChanged()
{
    if (mAction == nullptr || !mAction->isChecked())
        return;
    // While Alt is held, for example, Pencil2D switches to the eyedropper and back. The artist did not choose
    // it.
    const bool isHeld = QGuiApplication::queryKeyboardModifiers() != Qt::NoModifier;
    if (!isHeld && !mTemporarySwitch)
    {
        deactivate();
        return;
    }
    mTemporarySwitch = isHeld;
    uncheckOthers();
}

void ToolPalette::deactivate()
{
    mTemporarySwitch = false;
    if (mAction != nullptr)
        mAction->setChecked(false);
}

} // namespace lampblack
